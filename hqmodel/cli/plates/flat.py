"""Two dimensions drawn by Pillow: outlines filled, strips as bands between their bounding lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from PIL import Image, ImageDraw

from hqmodel.field import Terms, bounding_lines, mixed_colors
from hqmodel.model import Scene
from hqmodel.outline import Outline

from .sheet import GROUND, Size

Array = NDArray[np.float64]
Color = tuple[int, ...]

# Pictures are drawn so many times larger, and made smaller for smooth edges.
FINE = 4
# Of a stage's height: an outline's width, and a bounding line's.
_LINE, _THIN = 0.009, 0.004
# How much of the window a shape takes.
_FILLED = 0.84
_BAND, _BOUND = (96, 125, 160), (170, 170, 172)


@dataclass(frozen=True, eq=False)
class Window:
    """What part of the plane is seen: its middle (2,) and half its height, in a picture of that size."""

    middle: Array
    half: float
    size: Size

    @classmethod
    def around(cls, low: ArrayLike, high: ArrayLike, size: Size) -> Window:
        """Showing the rectangle from low to high (2,) with some room about it."""
        low, high = np.asarray(low), np.asarray(high)
        width, height = (high - low) / 2 / _FILLED
        return cls((low + high) / 2, float(max(height, width * size[1] / size[0])), size)

    def finer(self) -> Window:
        """The same, in a picture that is larger by `FINE`."""
        return Window(self.middle, self.half, (self.size[0] * FINE, self.size[1] * FINE))

    def pixels(self, points: Array) -> list[tuple[float, float]]:
        """Where points (n, 2) are seen."""
        width, height = self.size
        scaled = (points - self.middle) * [1, -1] * (height / 2 / self.half) + [width / 2, height / 2]
        return [(x, y) for x, y in scaled.tolist()]


def canvas(window: Window) -> tuple[Image.Image, ImageDraw.ImageDraw]:
    """An empty picture in the finer size."""
    picture = Image.new("RGB", (window.size[0] * FINE, window.size[1] * FINE), GROUND)
    return picture, ImageDraw.Draw(picture, "RGBA")


def finished(picture: Image.Image) -> Image.Image:
    return picture.resize((picture.width // FINE, picture.height // FINE), Image.Resampling.LANCZOS)


def draw_stage(scene: Scene, found: Outline, bounded: bool, low: Array, high: Array, size: Size) -> Image.Image:
    """The body's outline, filled, in the rectangle from low to high (2,); `bounded`, with the lines that bound its strips."""
    window = Window.around(low, high, size)
    picture, draw = canvas(window)
    for normal, offset in strips(scene) if bounded else ():
        draw_strip(draw, window, normal, offset, filled=False)
    draw_outline(draw, window, scene, found)
    return finished(picture)


def draw_outline(draw: ImageDraw.ImageDraw, window: Window, scene: Scene, found: Outline, filled: bool = True) -> None:
    """Each curve in its shape's colour; holes, which go round the other way, in the ground's."""
    fine, terms = window.finer(), Terms.of(scene)
    width = max(1, round(_LINE * fine.size[1]))
    for polygon in sorted(found.polygons(window.half / window.size[1] / FINE), key=_area, reverse=True):
        inside = np.append(np.mean(polygon, axis=0), 0.0)
        color = np.round(mixed_colors(scene, terms, inside[None])[0] * 255)
        dark = _color(color * 0.55)
        corners = fine.pixels(polygon)
        if filled:
            draw.polygon(corners, fill=_color(color) if _turn(polygon) > 0 else GROUND)
        draw.line([*corners, *corners[:2]], fill=dark, width=width, joint="curve")


def strips(scene: Scene) -> list[tuple[Array, float]]:
    """Each strip |n . (x, y) + d| <= 1 of the scene, as n (2,) and d."""
    terms = Terms.of(scene)
    return [(normal[:2], float(offset)) for normal, offset in zip(terms.normal, terms.offset, strict=True)]


def draw_strip(draw: ImageDraw.ImageDraw, window: Window, normal: Array, offset: float, filled: bool = True) -> None:
    """A strip's two bounding lines, and what lies between them shaded."""
    fine = window.finer()
    far = 4 * window.half * max(1.0, window.size[0] / window.size[1])
    edges = [fine.pixels(line) for line in bounding_lines(normal, offset, window.middle, far)]
    if filled:
        draw.polygon([*edges[0], *reversed(edges[1])], fill=(*_BAND, 70))
    for edge in edges:
        draw.line(edge, fill=_BAND if filled else _BOUND, width=max(1, round((_LINE if filled else _THIN) * fine.size[1])))


def _turn(polygon: Array) -> float:
    """Twice the area (n, 2) that is gone round counter-clockwise."""
    x, y = polygon.T
    return float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def _area(polygon: Array) -> float:
    return abs(_turn(polygon))


def _color(values: Array) -> Color:
    return tuple(int(value) for value in np.clip(values, 0, 255))
