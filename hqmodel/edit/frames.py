"""Slices through higher-dimensional shapes (eqs. 16-22, 38, 41): a shape's frame read out, put right, turned, replaced.

Each edit raises `EditError` with one line when the shape is not there or its strips allow no such frame.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import FRAMES, SOLIDS, make_frame, nearest_frame, turned_frame
from hqmodel.model import Scene, Shape, Strip, place

from .paths import EditError, get, put

# What a scene can be started from: the generated frames, and solids that are one of them at some slice.
STARTS = (*FRAMES, *SOLIDS, "hypercube", "random")
# So that a solid looks like one.
SHARP = 60.0

Frame = NDArray[np.float64]


def frame_of(scene: Scene, shape: int) -> Frame:
    """The normals and slice coefficients of the shape's strips, (N, 4): the columns A, B, C and D of eq. 41."""
    strips = get(scene, ("shapes", shape)).strips
    return np.array([(*strip.normal, strip.slice) for strip in strips])


def set_frame(scene: Scene, shape: int, rows: Frame) -> Scene:
    """The scene with other normals and slice coefficients, (N, 4), for the shape's N strips; all else stays."""
    old: Shape = get(scene, ("shapes", shape))
    if len(rows) != len(old.strips):
        raise EditError(f"{place(('shapes', shape, 'strips'))}: expected {len(rows)} strips, got {len(old.strips)}")
    strips = [strip.__dict__ | (strip.model_extra or {}) | _fields(row) for strip, row in zip(old.strips, rows, strict=True)]
    return put(scene, ("shapes", shape, "strips"), strips)


def make_orthonormal(scene: Scene, shape: int) -> Scene:
    """The shape in the orthonormal frame nearest to its own: a sphere at gamma = 2 without offsets, of radius sqrt(1 - t^2)."""
    try:
        return set_frame(scene, shape, nearest_frame(frame_of(scene, shape)))
    except ValueError as error:
        raise EditError(f"{place(('shapes', shape, 'strips'))}: {error}") from None


def turn_frame(scene: Scene, shape: int, plane: str, angle: float) -> Scene:
    """The shape turned by an angle in radians in a plane of four-space: xy, xz, yz, or xt, yt, zt, which tip the slice over."""
    return set_frame(scene, shape, turned_frame(frame_of(scene, shape), plane, angle))


def replace_frame(scene: Scene, shape: int, rows: Frame) -> Scene:
    """The shape with one plain strip for each row of a frame, (N, 4), in place of its own; they take its first one's exponent."""
    gamma = get(scene, ("shapes", shape, "strips", 0, "gamma"))
    bare = put(scene, ("shapes", shape, "strips"), [Strip(normal=(1.0, 0.0, 0.0), gamma=gamma)] * len(rows))
    return set_frame(put(bare, ("shapes", shape, "groups"), {}), shape, rows)


def framed_scene(name: str, gamma: float = SHARP, terms: int = 6, seed: int = 0) -> Scene:
    """A scene of one shape, one of `STARTS`, at the slice where the solid is; planar where the frame is.

    Raises EditError for a name that is not among them, too few terms, or an exponent out of range.
    """
    if name not in STARTS:
        raise EditError(f"frame: expected one of {', '.join(STARTS)}, got {name}")
    source, t = SOLIDS.get(name, (name, 0.0))
    try:
        rows = make_frame(source, terms, seed)
    except ValueError as error:
        raise EditError(f"terms: {error}") from None
    title = name.replace("-", " ").capitalize()
    shape = Shape(name=title, strips=(Strip(normal=(1.0, 0.0, 0.0)),))
    scene = Scene(name=title, dimension=3 if rows[:, 2].any() else 2, slice=t, shapes=(shape,))
    return replace_frame(put(scene, "gamma", gamma), 0, rows)


def _fields(row: Frame) -> dict[str, object]:
    """A strip's normal and slice coefficient as plain numbers, without negative zeros."""
    *normal, slice_rate = (row + 0.0).tolist()
    return {"normal": normal, "slice": slice_rate}
