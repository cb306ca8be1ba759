"""A strip's bounding planes pushed, slid and tilted, and new ones put where two planes shall be: pure functions on scenes.

A side is 1 for the plane h = 1 and -1 for h = -1; distances and directions are the world's. Each raises `EditError` with one
line when an index is not there or the result would not be a valid scene.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hqmodel.field import rotation_matrix, world_planes
from hqmodel.model import Scene, Shape, Strip

from .paths import Location, get, put_fields

# Two planes of a strip come no nearer than this share of their distance in one push.
CLOSEST = 1e-3


def push_plane(scene: Scene, shape: int, strip: int, side: int, distance: float) -> Scene:
    """One plane moved outwards by this distance; the opposite one stays where it is."""
    old, own = _own(scene, shape, strip)
    step = max(own * distance, 2 * old.half_width * (CLOSEST - 1))
    half_width, offset = old.half_width + step / 2, old.offset - side * step / 2
    return put_fields(scene, _place(shape, strip), half_width=half_width, offset=offset)


def spread_planes(scene: Scene, shape: int, strip: int, distance: float) -> Scene:
    """Both planes moved outwards by this distance; the strip's middle stays."""
    old, own = _own(scene, shape, strip)
    half_width = max(old.half_width + own * distance, old.half_width * CLOSEST)
    return put_fields(scene, _place(shape, strip), half_width=half_width)


def slide_strip(scene: Scene, shape: int, strip: int, side: int, distance: float) -> Scene:
    """Both planes moved together, towards that side by this distance."""
    old, own = _own(scene, shape, strip)
    return put_fields(scene, _place(shape, strip), offset=old.offset - side * own * distance)


def tilt_strip(scene: Scene, shape: int, strip: int, pivot: ArrayLike, turn: ArrayLike) -> Scene:
    """The strip turned about a world point (3,), its h there unchanged, by a 3 x 3 rotation matrix; as thick as before."""
    old, owner = get(scene, _place(shape, strip)), scene.shapes[shape]
    normals, offsets = world_planes(owner, scene.slice)
    about, length = np.asarray(pivot, dtype=float), float(np.linalg.norm(normals[strip]))
    direction = np.asarray(turn, dtype=float) @ normals[strip] / length
    if scene.dimension == 2:
        direction[2] = 0.0
        direction /= np.linalg.norm(direction)
    h = float(normals[strip] @ about + offsets[strip])
    middle = float(direction @ about) - h / length
    planes = placed(old, owner, scene.slice, direction, middle + 1 / length, middle - 1 / length)
    return put_fields(scene, _place(shape, strip), **planes)


def placed(strip: Strip, shape: Shape, t: float, direction: ArrayLike, near: float, far: float) -> dict[str, object]:
    """The fields that put the strip's planes at direction . x = near (h = 1) and = far (h = -1) at the slice t, x in the world.

    `direction` (3,) is a unit vector, near > far; the length of the strip's stored normal stays as it is.
    """
    u, transform = np.asarray(direction, dtype=float), shape.transform
    own: NDArray[np.float64] = np.array(transform.scale) * (rotation_matrix(transform.rotation).T @ u)
    share = float(np.linalg.norm(strip.normal) / np.linalg.norm(own))
    half, middle = share * (near - far) / 2, share * ((near + far) / 2 - float(u @ np.array(transform.translation)))
    normal = tuple(float(part) + 0.0 for part in share * own)  # + 0.0 makes -0.0 plain
    return {"normal": normal, "half_width": half, "offset": -middle - strip.slice * t}


def _own(scene: Scene, shape: int, strip: int) -> tuple[Strip, float]:
    """The strip, and how far n . p goes in its own frame for one world unit across it."""
    old: Strip = get(scene, _place(shape, strip))
    normals, _ = world_planes(scene.shapes[shape], scene.slice)
    return old, old.half_width * float(np.linalg.norm(normals[strip]))


def _place(shape: int, strip: int) -> Location:
    return "shapes", shape, "strips", strip
