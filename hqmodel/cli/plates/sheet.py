"""One figure's picture: rows of stages, what varies under each, and the caption."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PIL import Image, ImageDraw

from .lettering import INK, Text, font, write

PAPER = (255, 255, 255)
# The ground of what is drawn flat, and how much wider than high a wide stage is.
GROUND = (241, 240, 237)
WIDE = 1.5
# Longer rows are broken in two.
_LONGEST = 6
# Measures as shares of a stage's height: the margin, the gap, the line under a stage, the letters.
_MARGIN, _GAP, _LINE, _LETTER, _CAPTION = 0.08, 0.04, 0.15, 0.07, 0.08

Size = tuple[int, int]


@dataclass(frozen=True)
class Panel:
    """A stage: how it is drawn in a size, how much wider than high it is, and what is written under it."""

    draw: Callable[[Size], Image.Image]
    label: Text
    aspect: float = 1.0

    def size(self, height: int) -> Size:
        return round(height * self.aspect), height


def sheet(title: str, rows: Sequence[Sequence[Panel]], height: int, drawn: Callable[[float], None]) -> Image.Image:
    """The picture, each stage of it that many pixels high; `drawn` is told the share of the stages done."""
    rows = [part for row in rows for part in _broken(row)]
    margin, gap, line, letter, caption = (round(height * share) for share in (_MARGIN, _GAP, _LINE, _LETTER, _CAPTION))
    widths = [sum(panel.size(height)[0] for panel in row) + gap * (len(row) - 1) for row in rows]
    width = max(*widths, round(_title(ImageDraw.Draw(Image.new("RGB", (1, 1))), (0, 0), title, caption))) + 2 * margin
    below = [line if any(panel.label for panel in row) else gap for row in rows]
    picture = Image.new("RGB", (width, 2 * margin + len(rows) * height + sum(below) + 2 * caption), PAPER)
    draw = ImageDraw.Draw(picture)
    y = margin
    for row, own, under in zip(rows, widths, below, strict=True):
        x = (width - own) // 2
        for panel in row:
            size = panel.size(height)
            picture.paste(panel.draw(size), (x, y))
            write(draw, (x + size[0] / 2, y + height + line / 2), panel.label, letter)
            x += size[0] + gap
        drawn((y + height) / picture.height)
        y += height + under
    _title(draw, (margin, y + caption), title, caption)
    return picture


def _broken(row: Sequence[Panel]) -> list[Sequence[Panel]]:
    if len(row) <= _LONGEST:
        return [row]
    half = (len(row) + 1) // 2
    return [row[:half], row[half:]]


def _title(draw: ImageDraw.ImageDraw, at: tuple[int, int], title: str, size: int) -> float:
    """The figure's number in bold, then its title; where it ends."""
    number, _, words = title.partition(": ")
    bold, plain = font(size, "Bold"), font(size)
    draw.text(at, f"{number}.", INK, bold, anchor="lm")
    start = at[0] + bold.getlength(f"{number}. ")
    draw.text((start, at[1]), words[:1].upper() + words[1:], INK, plain, anchor="lm")
    return start + plain.getlength(words)
