"""From the hand's pixels to the world: how far something goes along a line when the pointer has moved so and so."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, degrees, floor, hypot, log10

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hqmodel.model import Camera

Array = NDArray[np.float64]
Pixels = tuple[float, float]

# The cosine from which on a line is seen end-on, and how many heights of the picture a point may be pulled at most.
_END_ON, _FARTHEST = 0.94, 10.0
# Snapping is to a decimal step, some so many pixels wide.
_STEP_PIXELS = 12.0


@dataclass(frozen=True)
class Aim:
    """The camera and the viewport's size (width, height), in the units that the pointer moves in; pixels from the top left.

    `grid` is the step of the grid to snap to, None for one that fits how large things are seen.
    """

    camera: Camera
    size: tuple[int, int]
    grid: float | None = None

    def per_pixel(self, point: ArrayLike) -> float:
        """World units that one pixel is wide at the depth of a world point (3,)."""
        camera = self.camera
        depth = camera.distance
        if not camera.orthographic:
            depth = max(float(camera.axes()[2] @ (camera.position() - np.asarray(point, dtype=float))), 1e-6 * depth)
        return 2 * camera.half_height() / self.size[1] * depth / camera.distance

    def pixel(self, point: ArrayLike) -> Array:
        """Where a world point (..., 3) is seen, (..., 2); NaN behind the eye."""
        return self.camera.project(point, self.size)

    def along(self, point: ArrayLike, direction: ArrayLike, moved: Pixels) -> float:
        """How far a world point (3,) goes along a unit direction (3,) when the hand has moved so many pixels (right, down).

        To where the line is nearest to what the pointer shows; but where it is seen nearly end-on, or not at all, up is forwards.
        """
        start, line = np.asarray(point, dtype=float), np.asarray(direction, dtype=float)
        depth = self.per_pixel(start) * self.size[1]
        seen = self.pixel(start)
        if not np.all(np.isfinite(seen)) or self.end_on(start, line):
            return -moved[1] * depth / self.size[1]
        (origin,), (ray,) = self.camera.rays([seen + moved], self.size)
        # nearest points of two lines: start + s line and origin + r ray
        slant, apart = float(line @ ray), origin - start
        s = (float(apart @ line) - slant * float(apart @ ray)) / max(1.0 - slant * slant, 1e-9)
        return float(np.clip(s, -_FARTHEST * depth, _FARTHEST * depth))

    def end_on(self, point: ArrayLike, direction: ArrayLike) -> bool:
        """Whether a unit direction (3,) at a world point (3,) points nearly at the eye, or away from it."""
        _, (ray,) = self.camera.rays([self.pixel(point)], self.size)
        return abs(float(np.asarray(direction) @ ray)) > _END_ON

    def across(self, point: ArrayLike, moved: Pixels) -> Array:
        """How far a world point (3,) goes in the picture's plane, (3,)."""
        right, up, _ = self.camera.axes()
        shift: Array = (moved[0] * right - moved[1] * up) * self.per_pixel(point)
        return shift

    def turned(self, pivot: ArrayLike, start: Pixels, moved: Pixels) -> float:
        """The angle, in degrees, that the pointer has gone round a world point (3,), counter-clockwise as it is seen."""
        x, y = self._middle(pivot)
        before, after = (start[0] - x, y - start[1]), (start[0] + moved[0] - x, y - start[1] - moved[1])
        turn = degrees(atan2(after[1], after[0]) - atan2(before[1], before[0]))
        return (turn + 180.0) % 360.0 - 180.0

    def spread(self, pivot: ArrayLike, start: Pixels, moved: Pixels) -> float:
        """How many times as far from a world point (3,) the pointer is as it was."""
        x, y = self._middle(pivot)
        before = max(hypot(start[0] - x, start[1] - y), 8.0)
        return max(hypot(start[0] + moved[0] - x, start[1] + moved[1] - y) / before, 1e-3)

    @property
    def step(self) -> float:
        """The grid's step: as it was chosen, else 1, 2 or 5 times a power of ten, easily aimed at from here."""
        if self.grid is not None:
            return self.grid
        width = self.per_pixel(self.camera.target) * _STEP_PIXELS
        decade = 10.0 ** floor(log10(width))
        return decade * next(k for k in (1, 2, 5, 10) if k * decade >= width)

    def _middle(self, point: ArrayLike) -> Array:
        """Where a world point (3,) is seen; one behind the eye in the picture's middle."""
        seen = self.pixel(point)
        return seen if np.all(np.isfinite(seen)) else np.array(self.size) / 2
