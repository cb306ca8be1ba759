"""The camera as a plain value: it orbits a target, z up, and every motion returns a new one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from math import cos, exp, isfinite, radians, sin, tan

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .scene import vector

Array = NDArray[np.float64]

VIEWS = {
    "front": (0.0, 0.0),
    "right": (90.0, 0.0),
    "back": (180.0, 0.0),
    "left": (270.0, 0.0),
    "top": (0.0, 90.0),
    "bottom": (0.0, -90.0),
    "iso": (35.0, 28.0),
}
DEGREES_PER_PIXEL = 0.4


@dataclass(frozen=True)
class Camera:
    """Looks at `target` from `distance` away. Azimuth 0 is the front, looking along +y; it grows towards the right side.

    Angles in degrees; `field_of_view` is the vertical one. An orthographic camera shows at its target what the
    perspective one would, so the two can be switched without a jump. Pixels count from the top left.
    """

    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    distance: float = 5.0
    azimuth: float = VIEWS["iso"][0]
    elevation: float = VIEWS["iso"][1]
    field_of_view: float = 30.0
    orthographic: bool = False

    def axes(self) -> Array:
        """Rows: the camera's right, up and back directions in the world, (3, 3)."""
        a, e = radians(self.azimuth), radians(self.elevation)
        right = (cos(a), sin(a), 0.0)
        back = (sin(a) * cos(e), -cos(a) * cos(e), sin(e))
        up = (-sin(a) * sin(e), cos(a) * sin(e), cos(e))
        return np.array([right, up, back])

    def position(self) -> Array:
        """The eye, (3,); for an orthographic camera a point on the same axis."""
        return np.asarray(self.target) + self.axes()[2] * self.distance

    def half_height(self) -> float:
        """Half the height of what is seen at the target, in world units."""
        return self.distance * tan(radians(self.field_of_view) / 2)

    def rays(self, pixels: ArrayLike, size: tuple[int, int]) -> tuple[Array, Array]:
        """Origins and unit directions (..., 3) of the rays through pixels (..., 2) of a picture of size (width, height)."""
        xy = np.asarray(pixels, dtype=float)
        width, height = size
        right, up, back = self.axes()
        x = (2 * xy[..., 0] - width) / height * self.half_height()
        y = (1 - 2 * xy[..., 1] / height) * self.half_height()
        across = np.asarray(self.target) + x[..., None] * right + y[..., None] * up
        if self.orthographic:
            return across + self.distance * back, np.broadcast_to(-back, across.shape)
        towards = across - self.position()
        return np.broadcast_to(self.position(), across.shape), towards / np.linalg.norm(towards, axis=-1, keepdims=True)

    def project(self, points: ArrayLike, size: tuple[int, int]) -> Array:
        """Pixels (..., 2) of world points (..., 3); NaN behind a perspective camera's eye."""
        width, height = size
        local = (np.asarray(points, dtype=float) - self.target) @ self.axes().T
        depth = np.full(local.shape[:-1], self.distance) if self.orthographic else self.distance - local[..., 2]
        scale = np.where(depth > 0, self.distance, np.nan) / np.where(depth > 0, depth, 1.0) / self.half_height() * height / 2
        return np.stack([width / 2 + local[..., 0] * scale, height / 2 - local[..., 1] * scale], axis=-1)

    def view_matrix(self) -> Array:
        """World to camera, (4, 4), for column vectors: the camera looks along its own -z, as OpenGL has it."""
        matrix = np.eye(4)
        matrix[:3, :3] = self.axes()
        matrix[:3, 3] = -self.axes() @ self.position()
        return matrix

    def projection_matrix(self, aspect: float, near: float, far: float) -> Array:
        """Camera to OpenGL's clip space, (4, 4), for column vectors; aspect is width / height."""
        half = self.half_height()
        matrix = np.zeros((4, 4))
        if self.orthographic:
            matrix[0, 0], matrix[1, 1] = 1 / (half * aspect), 1 / half
            matrix[2, 2], matrix[2, 3], matrix[3, 3] = -2 / (far - near), -(far + near) / (far - near), 1.0
        else:
            scale = self.distance / half
            matrix[0, 0], matrix[1, 1] = scale / aspect, scale
            matrix[2, 2], matrix[2, 3], matrix[3, 2] = -(far + near) / (far - near), -2 * far * near / (far - near), -1.0
        return matrix

    def orbited(self, dx: float, dy: float) -> Camera:
        """Turned about the target by a drag of so many pixels, the scene following the hand."""
        elevation = min(90.0, max(-90.0, self.elevation + dy * DEGREES_PER_PIXEL))
        return replace(self, azimuth=(self.azimuth - dx * DEGREES_PER_PIXEL) % 360.0, elevation=elevation)

    def panned(self, dx: float, dy: float, height: int) -> Camera:
        """Moved so that the point at the target follows a drag of so many pixels in a picture of that height."""
        right, up, _ = self.axes()
        step = 2 * self.half_height() / height
        return replace(self, target=vector(np.asarray(self.target) - right * dx * step + up * dy * step))

    def zoomed(self, steps: float, pixel: ArrayLike, size: tuple[int, int]) -> Camera:
        """Nearer by so many wheel steps, what lies under the pixel (at the target's depth) staying there."""
        factor = exp(-0.15 * steps)
        distance = min(1e9, max(1e-9, self.distance * factor))
        x, y = np.asarray(pixel, dtype=float)
        right, up, _ = self.axes()
        reach = self.half_height() * 2 / size[1] * (1 - distance / self.distance)
        shift = right * (x - size[0] / 2) * reach + up * (size[1] / 2 - y) * reach
        return replace(self, distance=distance, target=vector(np.asarray(self.target) + shift))

    def framing(self, low: ArrayLike, high: ArrayLike, aspect: float = 1.0, margin: float = 1.1) -> Camera:
        """The same view direction, moved so that the box from low to high (3,) fills the picture."""
        low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
        centre = (low + high) / 2
        signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        corners = signs * (high - low) / 2 @ self.axes().T
        slope = tan(radians(self.field_of_view) / 2)
        wide = np.maximum(np.abs(corners[:, 0]) / aspect, np.abs(corners[:, 1])) * margin
        needed = np.max(wide / slope + (0.0 if self.orthographic else corners[:, 2]))
        return replace(self, target=vector(centre), distance=max(float(needed), 1e-9))

    def looking(self, view: str) -> Camera:
        """Turned to one of the standard `VIEWS`; KeyError for any other name."""
        azimuth, elevation = VIEWS[view]
        return replace(self, azimuth=azimuth, elevation=elevation)


def usual(dimension: int) -> Camera:
    """Looking from the side that a body of that dimension is looked at from where nothing else is said."""
    return Camera().looking("top" if dimension == 2 else "iso")


def remembered(stored: object) -> Camera | None:
    """The camera that a preset keeps in its `view`, what is left out being as usual; None where it can't be used."""
    if not isinstance(stored, Mapping):
        return None
    defaults = asdict(Camera())
    known = {key: stored[key] for key in defaults if key in stored}
    target = known.get("target", defaults["target"])
    numbers = [known.get(key, defaults[key]) for key in ("distance", "azimuth", "elevation", "field_of_view")]
    if not isinstance(target, (list, tuple)) or len(target) != 3 or not all(map(_is_number, [*target, *numbers])):
        return None
    distance, azimuth, elevation, angle = map(float, numbers)
    if not (distance > 0 and abs(elevation) <= 90 and 0 < angle < 180):
        return None
    x, y, z = map(float, target)
    return Camera((x, y, z), distance, azimuth, elevation, angle, known.get("orthographic") is True)


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and isfinite(value)
