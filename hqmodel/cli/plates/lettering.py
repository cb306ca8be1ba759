"""Text in pictures: the fonts, and what is written under a stage, with the paper's letters for what varies."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from PIL import ImageDraw, ImageFont

from hqmodel.edit import Animation
from hqmodel.model import VIEWS

INK, FAINT = (38, 38, 40), (110, 110, 112)
# The paper's letters for the fields that its figures vary.
_LETTERS = {"gamma": "γ", "slice": "t", "level": "w", "coefficient": "c"}
_VIEWS = {azimuth: name for name, (azimuth, elevation) in VIEWS.items() if elevation == 0}

# A text is written in runs, each with whether it is a letter of mathematics, and so slanted.
Text = Sequence[tuple[str, bool]]


@cache
def font(size: int, style: str = "Regular") -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    """The font that the modeller's toolkit brings along: Pillow's own has no Greek."""
    toolkit = find_spec("imgui_bundle")
    if toolkit is not None and toolkit.origin is not None:
        path = Path(toolkit.origin).parent / "assets" / "fonts" / "Roboto" / f"Roboto-{style}.ttf"
        if path.exists():
            return ImageFont.truetype(str(path), size)  # which Pillow 10.1 wants
    return ImageFont.load_default(size)


def write(draw: ImageDraw.ImageDraw, centre: tuple[float, float], text: Text, size: int) -> None:
    """The text with its middle there."""
    fonts = [font(size, "RegularItalic" if slanted else "Regular") for _, slanted in text]
    x = centre[0] - sum(one.getlength(run) for one, (run, _) in zip(fonts, text, strict=True)) / 2
    for one, (run, _) in zip(fonts, text, strict=True):
        draw.text((x, centre[1]), run, INK, one, anchor="lm")
        x += one.getlength(run)


def label(animation: Animation, phase: float) -> Text:
    """What varies and what it is there: γ = 2, or γ = 60, 2, 2 where several numbers that go by one letter differ."""
    values: dict[str, list[float]] = {}
    for sweep in animation.sweeps:
        values.setdefault(sweep.path.rpartition(".")[2], []).append(sweep.at(phase))
    runs: list[tuple[str, bool]] = []
    for field, numbers in values.items():
        runs += [(", ", False)] if runs else []
        if field == "azimuth":
            runs.append((_VIEWS.get(numbers[0], f"{_number(numbers[0])}° from the front"), False))
        else:
            told = numbers[:1] if len(set(numbers)) == 1 else numbers
            runs += [(_LETTERS.get(field, field), True), (" = " + ", ".join(map(_number, told)), False)]
    return runs


def _number(value: float) -> str:
    return f"{value:g}".replace("-", "−")
