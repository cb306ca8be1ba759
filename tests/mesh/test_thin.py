"""Parts and grooves that a grid misses are named, and what is named to find them finds them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from hqmodel.files import builtin, load
from hqmodel.mesh import polygonize, report, thin_parts
from hqmodel.model import Scene, Shape, Strip, Transform

from ..cases import NAMES, case
from .volumes import volume

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
BALL = 4.18879


def plate(half: float, turn: tuple[float, float, float], **more: float) -> Shape:
    """A plate 2 by 2, turned by a rotation vector."""
    x, y, z, w = Rotation.from_rotvec(turn).as_quat().tolist()
    strips = tuple(Strip(normal=n, gamma=60.0, half_width=width) for n, width in ((X, 1.0), (Y, 1.0), (Z, half)))
    return Shape(strips=strips, hardness=20.0, transform=Transform(rotation=(x, y, z, w))).changed(**more)


def ball(at: float, scale: float = 1.0) -> Shape:
    placed = Transform(translation=(at, 0.0, 0.0), scale=(scale, scale, scale))
    return Shape(strips=tuple(Strip(normal=n) for n in (X, Y, Z)), hardness=20.0, transform=placed)


def beside(scene: Scene, whole: float, resolution: int) -> tuple[float, int]:
    """How much of what is beside the ball at 3 is there, and its Euler number; the mesh is closed."""
    mesh = polygonize(scene, resolution, shading=False)
    corners = mesh.vertices[mesh.faces] - mesh.vertices.mean(axis=0)
    of_ball = mesh.vertices[mesh.faces[:, 0], 0] >= 1.7
    measured = report(mesh)
    assert measured["watertight"]
    return (float(measured["volume"]) - float(np.linalg.det(corners[of_ball]).sum() / 6)) / whole, measured["euler_number"] - 2


@pytest.mark.parametrize(
    "turn", [(0.0, 0.0, 0.0), (0.02, 0.01, 0.0), (0.3, 0.2, 0.1), (0.6, 0.6, 0.3), (0.0, 0.0, 0.7), (1.1, -0.4, 2.0)]
)
@pytest.mark.parametrize("half", [0.02, 0.01, 0.001, 0.0001])
def test_a_plate_of_a_hundredth_of_a_cell_is_there_without_holes(turn: tuple[float, float, float], half: float) -> None:
    scene = Scene(shapes=(ball(3.0), plate(half, turn)))
    share, euler_number = beside(scene, 8 * half, 64)
    assert 0.8 < share < 1.02  # what is less is at its sides, where it ends within a cell
    assert euler_number == 2
    assert thin_parts(scene, 64) == []


@pytest.mark.parametrize("turn", [(0.3, 0.2, 0.1), (0.6, 0.6, 0.3), (1.1, -0.4, 2.0)])
@pytest.mark.parametrize("half", [0.1, 0.2])
def test_what_tapers_is_there_to_its_edge(turn: tuple[float, float, float], half: float) -> None:
    """A flat octahedron, 6 or 13 cells thick in its middle."""
    flat = plate(half, turn, hardness=1.0)
    body = flat.changed(strips=tuple(strip.changed(gamma=1.0) for strip in flat.strips))
    measured = report(polygonize(Scene(shapes=(body,)), 64, shading=False))
    assert measured["volume"] == pytest.approx(4 / 3 * half, rel=1.5e-3)
    assert measured["euler_number"] == 2


@pytest.mark.parametrize("turn", [(0.3, 0.2, 0.1), (0.6, 0.6, 0.3)])
@pytest.mark.parametrize("half", [0.02, 0.001])
def test_a_sheet_that_two_shapes_make_together(turn: tuple[float, float, float], half: float) -> None:
    """Neither comes to the level alone."""
    thin = plate(half, turn, hardness=1.0, coefficient=0.9, constant=0.0)
    broad = Shape(strips=tuple(Strip(normal=n, gamma=8.0) for n in (X, Y, Z)), coefficient=0.3, constant=0.0)
    scene = Scene(shapes=(thin.changed(strips=tuple(strip.changed(gamma=2.0) for strip in thin.strips)), broad))
    measured = report(polygonize(scene, 64, shading=False))
    assert measured["volume"] == pytest.approx(volume(scene), rel=0.02)
    assert measured["euler_number"] == 2


@pytest.mark.parametrize("turn", [(0.0, 0.0, 0.0), (0.3, 0.2, 0.1), (0.6, 0.6, 0.3)])
def test_a_groove_goes_right_through(turn: tuple[float, float, float]) -> None:
    """A ball in two halves, but for a bridge or two, shorter than a cell, where the groove comes out."""
    cut = plate(0.002, turn, coefficient=-1.0).changed(transform=plate(1.0, turn).transform.changed(scale=(1.2, 1.2, 1.2)))
    halves = report(polygonize(Scene(shapes=(ball(0.0), cut)), 64, shading=False))
    assert halves["watertight"]
    assert halves["euler_number"] >= -8
    assert halves["volume"] == pytest.approx(BALL - 2 * 0.0024 * math.pi, rel=2e-3)


@pytest.mark.parametrize("turn", [(0.3, 0.2, 0.1), (1.0, 0.5, -0.3)])
@pytest.mark.parametrize(("wide", "high"), [(0.01, 0.01), (0.02, 0.01), (0.04, 0.002), (0.03, 0.03)])
def test_a_rod_is_named_with_what_finds_it(wide: float, high: float, turn: tuple[float, float, float]) -> None:
    strips = tuple(Strip(normal=n, gamma=60.0, half_width=width) for n, width in ((X, 1.0), (Y, wide), (Z, high)))
    scene = Scene(shapes=(ball(3.0), plate(0.5, turn).changed(strips=strips)))
    ((shape, resolution),) = thin_parts(scene, 96)
    assert shape == 1
    share, euler_number = beside(scene, 8 * wide * high, resolution)
    assert share == pytest.approx(1.0, abs=0.12)
    assert euler_number == 2


def test_a_channel_is_named() -> None:
    strips = tuple(Strip(normal=n, gamma=60.0, half_width=width) for n, width in ((X, 2.0), (Y, 0.006), (Z, 0.006)))
    scene = Scene(shapes=(ball(0.0), plate(0.5, (0.3, 0.2, 0.1), coefficient=-1.0).changed(strips=strips)))
    assert [part.shape for part in thin_parts(scene, 64)] == [1]
    assert thin_parts(scene, 600) == []


def test_what_is_thin_but_within_a_body_or_of_no_effect_is_not_named() -> None:
    hidden = plate(0.003, (0.3, 0.2, 0.1))
    assert thin_parts(Scene(shapes=(ball(0.0, 2.0), hidden)), 64) == []
    assert thin_parts(Scene(shapes=(ball(9.0), hidden.changed(coefficient=-1.0))), 64) == []
    assert thin_parts(Scene(shapes=()), 64) == []


def test_a_sheet_without_end_is_whole_within_its_bounds() -> None:
    sheet = Shape(strips=(Strip(normal=(0.3, 0.5, 1.0), half_width=0.004, gamma=8.0),))
    scene = Scene(shapes=(sheet,), bounds=((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0)))
    assert thin_parts(scene, 64) == []
    measured = report(polygonize(scene, 64, shading=False))
    assert measured["watertight"]
    assert measured["euler_number"] == 2
    # the plane meets the box in a parallelogram: over 2 x 2 in x and y where it stays within |z| <= 1
    assert measured["volume"] == pytest.approx(4 * 0.008, rel=0.01)


def test_nothing_is_named_in_vain() -> None:
    """Of the built-in presets and the reference cases all have whole meshes as they are exported."""
    scenes = [load(preset.path) for preset in builtin()] + [case(name).scene for name in NAMES]
    assert [scene.name for scene in scenes if thin_parts(scene)] == []
