"""The landscape of a sum of exponentials over the plane, cut by the level plane w = const (Hanson 1988, figures 16-18).

Seen from above, all that lies under the level plane is behind it and all that rises over it is in front: so the land below is
drawn first, then the plane, then the land above, each from the back to the front.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from hqmodel.field import Terms, landscape, mixed_colors
from hqmodel.model import Camera, Scene
from hqmodel.outline import Outline

from .flat import FINE, finished
from .sheet import GROUND, Size

Array = NDArray[np.float64]

# Pictures no larger than this either way are drawn: their finer originals take memory.
LARGEST = 4096
# Squares of land along a side, and how much higher than wide the land is drawn.
_SQUARES, _STEEP = 88, 0.7
VIEW = Camera(azimuth=24.0, elevation=34.0, orthographic=True)
_LIGHT = np.array([-0.45, -0.35, 0.82])
_PLANE, _CURVE = (70, 96, 130, 96), (30, 42, 60)
# Of a stage's height: the section's width.
_LINE = 0.012


@dataclass(frozen=True, eq=False)
class Land:
    """Squares over the rectangle from low to high (2,): corners (n, 4, 3) and colours (n, 3) in 0..255."""

    low: Array
    high: Array
    corners: Array
    colors: Array

    @property
    def steep(self) -> float:
        """How much heights are drawn larger."""
        return _STEEP * float(np.min(self.high - self.low)) / 2


def draw_landscape(land: Land, level: float, section: Outline | None, size: Size, view: Camera = VIEW) -> Image.Image:
    """The land, and its section at a level where there is one, as the camera sees it from above, all in the picture."""
    fine = (size[0] * FINE, size[1] * FINE)
    picture = Image.new("RGB", fine, GROUND)
    draw = ImageDraw.Draw(picture, "RGBA")
    low, high, steep = land.low, land.high, land.steep
    bottom, top = (edge(land.corners[..., 2], initial=level) * steep for edge in (np.min, np.max))
    camera = view.framing([*low, bottom], [*high, top], size[0] / size[1], margin=1.04)

    def seen(points: Array) -> list[tuple[float, float]]:
        return [(x, y) for x, y in camera.project(points * [1, 1, steep], fine).tolist()]

    back_to_front = np.argsort(np.mean(land.corners, axis=1)[:, :2] @ camera.axes()[2, :2], kind="stable")
    land = replace(land, corners=land.corners[back_to_front], colors=land.colors[back_to_front])

    for polygon, color in pieces(land, level, below=True):
        draw.polygon(seen(polygon), fill=color)
    corners = np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]])
    draw.polygon(seen(np.column_stack([corners, np.full(4, level)])), fill=_PLANE, outline=(*_CURVE, 160), width=FINE)
    for polygon in section.polygons(1e-3 * float(np.max(high - low))) if section else ():
        curve = seen(np.column_stack([polygon, np.full(len(polygon), level)]))
        draw.line([*curve, *curve[:2]], fill=_CURVE, width=max(1, round(_LINE * fine[1])), joint="curve")
    for polygon, color in pieces(land, level, below=False):
        draw.polygon(seen(polygon), fill=color)
    return finished(picture)


def land_of(scene: Scene, low: Array | None = None, high: Array | None = None) -> Land:
    """The landscape of the scene's sum, over the rectangle from low to high (2,), or the body's, and as far about it as the land
    is not flat."""
    terms = replace(Terms.of(scene), level=0.0)
    found = landscape(scene, _SQUARES, low, high)
    corners = found.squares()
    land = Land(found.low, found.high, corners, np.empty(0))
    steep = np.array([1.0, 1.0, land.steep])
    normal = np.cross((corners[:, 2] - corners[:, 0]) * steep, (corners[:, 3] - corners[:, 1]) * steep)
    light = np.maximum(normal @ _LIGHT / np.linalg.norm(normal, axis=1) / np.linalg.norm(_LIGHT), 0.0)
    middle = np.mean(corners, axis=1)
    own = mixed_colors(scene, terms, middle * [1, 1, 0]) * 255
    risen = np.clip(np.abs(middle[:, 2:]) * 4, 0, 1)
    colors = (np.array(GROUND) * (1 - risen) * 0.98 + own * risen) * (0.45 + 0.6 * light[:, None])
    return replace(land, colors=np.clip(colors, 0, 255))


def pieces(land: Land, level: float, below: bool) -> Iterator[tuple[Array, tuple[int, ...]]]:
    """The parts of squares on one side of the level, polygons (k, 3), with their colours."""
    side = -1.0 if below else 1.0
    heights = side * (land.corners[..., 2] - level)
    for corners, height, color in zip(land.corners, heights, land.colors.astype(int).tolist(), strict=True):
        if np.all(height >= 0):
            yield corners, tuple(color)
        elif np.any(height > 0):
            yield _clipped(corners, height), tuple(color)


def _clipped(corners: Array, height: Array) -> Array:
    """What is left of a polygon (k, 3) where the height at its corners (k,) is not negative."""
    found = []
    for index in range(len(corners)):
        a, b = corners[index - 1], corners[index]
        h, k = height[index - 1], height[index]
        if h * k < 0:
            found.append(a + (b - a) * (h / (h - k)))
        if k >= 0:
            found.append(b)
    return np.array(found)
