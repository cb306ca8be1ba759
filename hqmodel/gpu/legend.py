"""What the colours of the curvature mode mean: one scale for the shader, the window and the picture's own legend."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import asinh, ceil, floor, log10
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from hqmodel.field import Region, srgb_to_linear

# sRGB, evenly placed from the scale's lower end to its upper: saddles blue, flat grey, domes and hollows orange.
COLORS = ((24, 54, 132), (58, 104, 200), (140, 168, 222), (210, 210, 208), (236, 178, 138), (218, 104, 48), (142, 40, 12))
# Places on the scale go by asinh: even around 0, by logarithm from this share of the end on.
_KNEE = 1 / 100
# What is at the end of the scale, for a body whose longest half-side is 1.
_END = 100.0


@dataclass(frozen=True)
class Legend:
    """The scale of Gaussian curvature, per world unit squared, from -`limit` to `limit`; what is beyond has the end's colour."""

    limit: float

    @classmethod
    def of(cls, region: Region) -> Legend:
        """A scale for the body in that region, its end 1, 2 or 5 times a power of ten."""
        wanted = _END / max(float(np.max(region.size)) / 2, 1e-100) ** 2
        power = 10.0 ** floor(log10(wanted))
        return cls(power * max(step for step in (1, 2, 5) if step * power <= wanted * (1 + 1e-9)))

    @property
    def colors(self) -> tuple[tuple[int, int, int], ...]:
        """sRGB colours, 0 to 255, evenly placed from -limit to limit; linear light is mixed between them."""
        return COLORS

    def place(self, curvature: float) -> float:
        """Where a curvature lies on the scale: 0 at -limit, 1/2 at 0, 1 at limit."""
        return 0.5 + 0.5 * asinh(curvature / (self.limit * _KNEE)) / asinh(1 / _KNEE)

    def ticks(self) -> list[tuple[float, str]]:
        """Places on the scale and the numbers that belong there, upwards."""
        sizes = [self.limit * share for share in (0.1, 1.0)]
        values = [*[-size for size in reversed(sizes)], 0.0, *sizes]
        return [(self.place(value), f"{value:+g}" if value else "0") for value in values]

    def uniforms(self, scale: float) -> dict[str, Any]:
        """What surface.frag is told, with lengths in a unit frame of that scale."""
        colors = srgb_to_linear(np.array(COLORS) / 255)
        return {
            "curvature_colors": [tuple(color) for color in colors.tolist()],
            "curvature_rate": 1 / (self.limit * _KNEE * scale**2),
            "curvature_half": 0.5 / asinh(1 / _KNEE),
        }


def with_legend(pixels: NDArray[np.uint8], legend: Legend) -> NDArray[np.uint8]:
    """The picture, (height, width, 4), with the scale at its right, where there is room for one."""
    height, width = pixels.shape[:2]
    text = round(min(max(height / 34, 10), 40))
    if height < 12 * text or width < 16 * text:
        return pixels
    picture = Image.fromarray(pixels)
    draw, font = ImageDraw.Draw(picture), ImageFont.load_default(text)
    bar = _bar(ceil(0.9 * text), round(height * 0.5))
    left, top = width - round(5.5 * text), round(height * 0.25)
    picture.paste(bar, (left, top))
    draw.text((width - text, top - text), "Gaussian curvature", "#d8d8d8", font, anchor="rb")
    for place, number in legend.ticks():
        y = top + round((1 - place) * (bar.height - 1))
        draw.line([(left + bar.width, y), (left + bar.width + text // 3, y)], "#d8d8d8", max(1, text // 12))
        draw.text((left + bar.width + text // 2, y), number, "#d8d8d8", font, anchor="lm")
    return np.array(picture)


def _bar(width: int, height: int) -> Image.Image:
    column: Sequence[NDArray[np.float64]] = [
        np.interp(np.linspace(1, 0, height), np.linspace(0, 1, len(COLORS)), part) for part in np.array(COLORS, dtype=float).T
    ]
    rows = np.stack(column, axis=-1).round().astype(np.uint8)
    return Image.fromarray(np.repeat(rows[:, None], width, axis=1))
