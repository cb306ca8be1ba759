"""Frames: orthonormal, restored to the nearest, turned in four-space; the solids that they make, by closed forms."""

from __future__ import annotations

from itertools import product
from math import pi, sqrt
from pathlib import Path

import numpy as np
import pytest
from numpy.random import default_rng
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, HalfspaceIntersection

from hqmodel.field import (
    FRAMES,
    PLANES,
    SOLIDS,
    Terms,
    frame_residual,
    make_frame,
    nearest_frame,
    slice_range,
    turned_frame,
    value,
)
from hqmodel.model import Scene, Shape, Strip

Array = NDArray[np.float64]
GOLDEN = (1 + sqrt(5)) / 2
# Corners, faces, edges, and the volume over the cube of the edge.
REGULAR = {
    "tetrahedron": (4, 4, 6, sqrt(2) / 12),
    "cube": (8, 6, 12, 1),
    "octahedron": (6, 8, 12, sqrt(2) / 3),
    "dodecahedron": (20, 12, 30, (15 + 7 * sqrt(5)) / 4),
    "icosahedron": (12, 20, 30, 5 * (3 + sqrt(5)) / 12),
    "truncated-tetrahedron": (12, 8, 18, 23 * sqrt(2) / 12),
    "cuboctahedron": (12, 14, 24, 5 * sqrt(2) / 3),
    "truncated-octahedron": (24, 14, 36, 8 * sqrt(2)),
    "truncated-cube": (24, 14, 36, (21 + 14 * sqrt(2)) / 3),
    "rhombicuboctahedron": (24, 26, 48, (12 + 10 * sqrt(2)) / 3),
    "truncated-cuboctahedron": (48, 26, 72, 22 + 14 * sqrt(2)),
    "icosidodecahedron": (30, 32, 60, (45 + 17 * sqrt(5)) / 6),
    "truncated-icosahedron": (60, 32, 90, (125 + 43 * sqrt(5)) / 4),
    "truncated-dodecahedron": (60, 32, 90, 5 * (99 + 47 * sqrt(5)) / 12),
    "rhombicosidodecahedron": (60, 62, 120, (60 + 29 * sqrt(5)) / 3),
    "truncated-icosidodecahedron": (120, 62, 180, 95 + 50 * sqrt(5)),
}
RHOMBIC = {
    "rhombic-dodecahedron": (14, 12, 24, 16 * sqrt(3) / 9),
    "rhombic-triacontahedron": (32, 30, 60, 4 * sqrt(5 + 2 * sqrt(5))),
}
MADE = {name: make_frame(name) for name in FRAMES} | {
    f"{name}-{terms}": make_frame(name, terms, terms) for name in ("hypercube", "random") for terms in (4, 5, 6, 31)
}
frames = pytest.mark.parametrize("frame", MADE.values(), ids=MADE)


def scene_of(frame: Array, gamma: float, t: float = 0.0) -> Scene:
    strips = tuple(Strip(normal=(a, b, c), slice=d, gamma=gamma) for a, b, c, d in frame.tolist())
    return Scene(slice=t, shapes=(Shape(strips=strips),))


def outer(name: str) -> ConvexHull:
    """What the shape of a solid's name grows into with its exponents, |h_a| <= 1 for every strip (eq. 12)."""
    source, t = SOLIDS.get(name, (name, 0.0))
    rows = _planes(make_frame(source), t)
    return _polytope(np.concatenate([rows, -rows]))


def inner(frame: str, t: float) -> ConvexHull:
    """The shape with every exponent 1, sum_a |h_a| <= 1."""
    rows = _planes(make_frame(frame), t)
    return _polytope(np.array(list(product((1.0, -1.0), repeat=len(rows)))) @ rows)


def _planes(frame: Array, t: float) -> Array:
    return np.column_stack([frame[:, :3], frame[:, 3] * t])


def _polytope(rows: Array) -> ConvexHull:
    """row . (x, 1) <= 1, with each of its corners once."""
    rows = rows[np.any(np.abs(rows[:, :3]) > 1e-9, axis=1)]
    corners = HalfspaceIntersection(rows - np.eye(4)[3], np.zeros(3)).intersections
    return ConvexHull(np.unique(corners.round(9), axis=0))


def _edges(hull: ConvexHull) -> Array:
    """The lengths of a polytope's edges."""
    ends = {
        tuple(sorted(np.delete(corners, i).tolist()))
        for corners, others, plane in zip(hull.simplices, hull.neighbors, hull.equations, strict=True)
        for i in range(3)
        if np.max(np.abs(hull.equations[others[i]] - plane)) > 1e-6
    }
    a, b = np.array(sorted(ends)).T
    return np.linalg.norm(hull.points[a] - hull.points[b], axis=1)


def _faces(hull: ConvexHull) -> int:
    return len(np.unique(hull.equations.round(6), axis=0))


@frames
def test_generated_frames_are_orthonormal(frame: Array) -> None:
    assert frame_residual(frame) < 1e-12
    assert np.all(np.any(frame[:, :3] != 0, axis=1))


@frames
def test_a_frame_is_a_sphere_at_gamma_2(frame: Array) -> None:
    """Of radius sqrt(1 - t^2), where t takes part; in the plane a circle."""
    flat = 1.0 * np.any(frame != 0, axis=0)
    away = default_rng(2).normal(size=(50, 3)) * flat[:3]
    t = 0.6 * flat[3]
    on = sqrt(1 - t * t) * away / np.linalg.norm(away, axis=1, keepdims=True)
    np.testing.assert_allclose(value(Terms.of(scene_of(frame, 2.0, t)), on), 0, atol=1e-12)


@pytest.mark.parametrize("name", REGULAR)
def test_regular_and_semi_regular_solids(name: str) -> None:
    hull = outer(name)
    _holds(hull, *REGULAR[name])
    away = np.linalg.norm(hull.points - hull.points.mean(axis=0), axis=1)
    np.testing.assert_allclose(away, away[0], rtol=1e-7)


@pytest.mark.parametrize("name", RHOMBIC)
def test_rhombic_solids(name: str) -> None:
    _holds(outer(name), *RHOMBIC[name])


def _holds(hull: ConvexHull, corners: int, faces: int, count: int, volume: float) -> None:
    """So many corners, faces and edges, all edges as long, and the volume where they are of length 1."""
    edges = _edges(hull)
    assert (len(hull.vertices), _faces(hull), len(edges)) == (corners, faces, count)
    np.testing.assert_allclose(edges, edges[0], rtol=1e-7)
    assert hull.volume == pytest.approx(volume * edges[0] ** 3, rel=1e-7)


def test_the_documentation_tells_them_right() -> None:
    """Its table of solids: frame, exponent, slice, strips, corners and faces."""
    text = (Path(__file__).parents[2] / "docs" / "frames.md").read_text()
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in text.splitlines() if line.startswith("| ")][2:]
    told = set()
    for _, frame, exponent, t, strips, corners, faces in rows:
        name, _, source = frame.partition(" = ")
        source = source or name
        assert SOLIDS.get(name, (source, 0.0)) == (source, float(t))
        rows_of = make_frame(source)
        assert len(rows_of) == int(strips)
        hull = outer(name) if exponent == "large" else inner(source, float(t))
        assert (len(hull.vertices), _faces(hull)) == (int(corners), int(faces))
        told.add(name)
    assert told == {*FRAMES, *SOLIDS} - {"simplex3", "ico10"}


def test_every_solid_is_judged() -> None:
    assert {*REGULAR, *RHOMBIC} == {"cube", *SOLIDS, *(name for name in FRAMES if not name[-1].isdigit())}


@pytest.mark.parametrize(
    ("frame", "t", "corners", "faces", "volume"),
    [
        ("cube", 0.0, 6, 8, 4 / 3),
        ("hadamard4", 0.0, 12, 14, 5 / 6),
        ("hadamard4", 0.25, 12, 14, 1 - 4 * (0.75**3 + 0.25**3) / 6),
        ("octahedral6", 0.0, 14, 24, None),
        ("ico6", 0.0, 30, 32, None),
        ("ico15", 0.0, 62, 120, None),
        ("simplex5", 0.0, 8, 12, None),
    ],
)
def test_slices_of_cross_polytopes(frame: str, t: float, corners: int, faces: int, volume: float | None) -> None:
    """The octahedron, cuboctahedron, a cube with corners cut, tetrakis hexahedron, icosidodecahedron, disdyakis
    triacontahedron and hexagonal bipyramid.
    """
    hull = inner(frame, t)
    assert (len(hull.vertices), _faces(hull)) == (corners, faces)
    assert volume is None or hull.volume == pytest.approx(volume)


def test_the_nearest_frame_leaves_a_pure_stretch() -> None:
    """F = Q S with S symmetric and positive is the polar decomposition, whose Q is the nearest orthonormal frame."""
    frame = make_frame("random", 9, 1) + 0.2 * default_rng(3).normal(size=(9, 4))
    nearest = nearest_frame(frame)
    stretch = nearest.T @ frame
    assert frame_residual(nearest) < 1e-12
    np.testing.assert_allclose(stretch, stretch.T, atol=1e-12)
    assert np.all(np.linalg.eigvalsh(stretch) > 0)
    np.testing.assert_allclose(nearest_frame(nearest), nearest, atol=1e-14)


@pytest.mark.parametrize("name", ["cube", "simplex3", "ico6"])
def test_columns_that_take_no_part_stay_so(name: str) -> None:
    frame = make_frame(name) @ np.diag([2.0, 0.5, 3.0, 0.1])
    np.testing.assert_allclose(nearest_frame(frame), make_frame(name), atol=1e-14)


@pytest.mark.parametrize("frame", [[(1, 2, 0, 0)], [(1, 1, 0, 0), (2, 2, 0, 0)], [(1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 1)]])
def test_dependent_columns_have_no_nearest_frame(frame: list[tuple[float, ...]]) -> None:
    with pytest.raises(ValueError, match=r"expected [24] independent columns A, B, C and D"):
        nearest_frame(np.array(frame, dtype=float))


@pytest.mark.parametrize("plane", PLANES)
def test_a_turned_frame_is_the_shape_turned(plane: str) -> None:
    """h at a turned point of four-space is what it was at the point."""
    frame, points = make_frame("random", 7, 5), default_rng(4).normal(size=(30, 4))
    i, j = PLANES[plane]
    moved = points.copy()
    turn = np.exp(0.7j) * (points[:, i] + 1j * points[:, j])
    moved[:, i], moved[:, j] = turn.real, turn.imag
    np.testing.assert_allclose(turned_frame(frame, plane, 0.7) @ moved.T, frame @ points.T, atol=1e-14)
    assert frame_residual(turned_frame(frame, plane, 0.7)) < 1e-12
    np.testing.assert_allclose(turned_frame(frame, plane, 2 * pi), frame, atol=1e-14)


def test_random_frames_come_from_their_seed() -> None:
    assert np.array_equal(make_frame("random", 8, 3), make_frame("random", 8, 3))
    assert not np.allclose(make_frame("random", 8, 3), make_frame("random", 8, 4))
    for name in ("random", "hypercube"):
        with pytest.raises(ValueError, match="expected at least 4 terms"):
            make_frame(name, 3)


@pytest.mark.parametrize("gamma", [1.0, 1.5, 2.0, 7.0, 400.0])
def test_the_range_of_a_slice_along_the_diagonal(gamma: float) -> None:
    """The last of the body is its middle, where N strips all have |h| = |t| / sqrt(N)."""
    for name, terms in (("hadamard4", 4), ("hypercube", 9), ("simplex3", 3)):
        found = slice_range(scene_of(make_frame(name, terms), gamma))
        last = sqrt(terms) * terms ** (-1 / gamma)
        assert found == pytest.approx((-last, last), rel=1e-8)


def test_no_body_outside_the_range() -> None:
    for seed in range(6):
        rng = default_rng(seed)
        scene = scene_of(make_frame("random", 4 + seed, seed), float(rng.choice([0.6, 1.0, 3.0, 40.0])))
        found = slice_range(scene)
        assert found is not None
        for t in (1.02 * found[0], 1.02 * found[1]):
            points = rng.normal(size=(20_000, 3)) * rng.exponential(size=(20_000, 1))
            assert np.all(value(Terms.of(scene.changed(slice=t)), points) < 0)


def test_what_does_not_move_or_has_no_end_has_no_range() -> None:
    assert slice_range(scene_of(make_frame("cube"), 2.0)) is None
    assert slice_range(Scene(shapes=())) is None
    hyperbolic = scene_of(make_frame("hadamard4"), 2.0)
    strips = (hyperbolic.shapes[0].strips[0].changed(sign=-1), *hyperbolic.shapes[0].strips[1:])
    assert slice_range(hyperbolic.changed(shapes=(Shape(strips=strips),))) is None


def test_the_range_of_a_blend_holds_every_shape() -> None:
    one, two = make_frame("hadamard4"), make_frame("random", 6, 2)
    scenes = [scene_of(frame, 3.0) for frame in (one, two)]
    both = scenes[0].changed(shapes=scenes[0].shapes + scenes[1].shapes)
    ranges = [slice_range(scene) for scene in (*scenes, both)]
    assert all(found is not None for found in ranges)
    low, high = np.array(ranges).T
    assert low[2] <= low[:2].min()
    assert high[2] >= high[:2].max()
