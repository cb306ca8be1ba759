"""What the shaders are told of the camera and of the lights, which turn with it as in a photographer's studio."""

from __future__ import annotations

from math import cos, radians, sin, tan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Plane, Region
from hqmodel.model import Camera, vector

from .packing import Frame

Array = NDArray[np.float64]
# Directions towards each light: parts to the camera's right, away from the camera along the floor, and up.
KEY = (-0.62, -0.52, 0.95)
FILL = (0.90, -0.50, 0.25)
RIM = (0.45, 0.90, 0.55)
# Tangent of half the angle that the key light fills: the width of its soft shadows.
KEY_RADIUS = 0.22


def camera_uniforms(camera: Camera, size: tuple[int, int], frame: Frame) -> dict[str, Any]:
    """The camera in the unit frame, for a picture of that size (width, height)."""
    right, up, back = camera.axes()
    half = camera.half_height() / frame.scale if camera.orthographic else tan(radians(camera.field_of_view) / 2)
    return {
        "eye": tuple(frame.local(camera.position())),
        "camera_right": tuple(right),
        "camera_up": tuple(up),
        "camera_back": tuple(back),
        "half_picture": (half * size[0] / size[1], half),
        "orthographic": int(camera.orthographic),
    }


def light_uniforms(camera: Camera) -> dict[str, Any]:
    """Where the lights are."""
    azimuth = radians(camera.azimuth)
    right, away = np.array([cos(azimuth), sin(azimuth), 0.0]), np.array([-sin(azimuth), cos(azimuth), 0.0])
    stand = np.stack([right, away, [0.0, 0.0, 1.0]])
    names = {"key_direction": KEY, "fill_direction": FILL, "rim_direction": RIM}
    return {name: tuple(_unit(np.array(parts) @ stand)) for name, parts in names.items()}


def cut_uniform(cut: Plane | None, frame: Frame) -> tuple[float, float, float, float]:
    """The half-space that is drawn, behind the plane as seen from the side that its normal points to, in the unit frame."""
    if cut is None:
        return 0.0, 0.0, 0.0, 1.0
    normal = cut.axes[2]
    return *vector(normal), float(normal @ frame.local(cut.origin))


def depth_range(camera: Camera, region: Region, frame: Frame) -> tuple[float, float]:
    """Distances from the eye, in the unit frame, between which the body lies."""
    radius = float(np.linalg.norm(region.size)) / 2 / frame.scale
    from_centre = frame.local(camera.position())
    middle = float(from_centre @ camera.axes()[2]) if camera.orthographic else float(np.linalg.norm(from_centre))
    return max(middle - radius, 0.0), middle + radius


def _unit(vector: Array) -> Array:
    result: Array = vector / np.linalg.norm(vector)
    return result
