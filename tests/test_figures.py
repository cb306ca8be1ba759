"""The presets of the paper's figures (Hanson 1988): all are there, their sweeps run, their stages are what closed forms say."""

from __future__ import annotations

import re
from functools import cache
from itertools import pairwise, product
from math import gamma, pi, sqrt

import numpy as np
import pytest
from numpy.random import default_rng
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import ConvexHull, HalfspaceIntersection

from hqmodel.edit import get, put
from hqmodel.field import Terms, value
from hqmodel.files import Builtin, builtin, load
from hqmodel.mesh import Mesh, polygonize, report
from hqmodel.model import Scene
from hqmodel.outline import outline

Array = NDArray[np.float64]

FIGURES = [preset for preset in builtin() if preset.collection == "figures"]
RESOLUTION = 64

each = pytest.mark.parametrize("preset", FIGURES, ids=lambda preset: preset.name)


@cache
def figure(number: int) -> Scene:
    return load(next(preset.path for preset in FIGURES if preset.name.startswith(f"fig{number:02d}-")))


def stages(scene: Scene, animation: int = 0) -> list[Scene]:
    """The scene at each keyframe of one of its animations."""
    sweeps = scene.animations[animation]["sweeps"]
    result = [scene] * len(sweeps[0]["values"])
    for sweep in sweeps:
        result = [put(stage, sweep["path"], number) for stage, number in zip(result, sweep["values"], strict=True)]
    return result


def stage_where(number: int, path: str, wanted: float) -> Scene:
    return next(stage for stage in stages(figure(number)) if get(stage, path) == wanted)


def solid(scene: Scene) -> Mesh:
    return polygonize(scene, RESOLUTION, shading=False)


def area(scene: Scene) -> float:
    return outline(scene, precision=1e-3).area


def planes(scene: Scene) -> Array:
    """h = row . (x, 1) of the strips of a scene of one shape, in the shape's own frame, (S, dimension + 1)."""
    strips = scene.shapes[0].strips
    rows = [[*s.normal[: scene.dimension], s.slice * scene.slice + s.offset] for s in strips]
    return np.array(rows) / np.array([[s.half_width] for s in strips])


def outer(scene: Scene) -> ConvexHull:
    """What the shape grows into with its exponents, |h_a| <= 1 for every strip (eq. 12)."""
    return _hull(np.concatenate([planes(scene), -planes(scene)]))


def inner(scene: Scene) -> ConvexHull:
    """The shape with every exponent 1, sum_a |h_a| <= 1."""
    return _hull(np.array(list(product((1.0, -1.0), repeat=len(planes(scene))))) @ planes(scene))


def _hull(rows: Array) -> ConvexHull:
    """The polytope row . (x, 1) <= 1, with each of its corners once; the strips' common middle must lie inside."""
    rows = rows[np.any(np.abs(rows[:, :-1]) > 1e-9, axis=1)]
    middle = -np.linalg.pinv(rows[:, :-1]) @ rows[:, -1]
    halves = rows - np.eye(rows.shape[1])[-1]
    return ConvexHull(np.unique(HalfspaceIntersection(halves, middle).intersections.round(9), axis=0))


def counts(hull: ConvexHull) -> tuple[int, int]:
    """How many corners and faces a polytope has."""
    return len(hull.vertices), len(np.unique(hull.equations.round(6), axis=0))


def alike(some: Array, others: Array) -> bool:
    """Whether two sets of points are one."""
    apart = np.linalg.norm(some[:, None] - others, axis=-1)
    return len(some) == len(others) and bool(np.all(np.min(apart, axis=1) < 1e-8))


def pieces(mesh: Mesh) -> int:
    """How many parts a mesh falls into."""
    edges = coo_array((np.ones(3 * len(mesh.faces)), (mesh.faces.ravel(), np.roll(mesh.faces, 1, axis=1).ravel())))
    return int(connected_components(edges, directed=False, return_labels=False))


def spread(count: int, dimension: int) -> Array:
    """Unit directions, (count, 3), in the plane z = 0 where the dimension is 2."""
    away = default_rng(1).normal(size=(count, 3))
    away[:, dimension:] = 0
    return away / np.linalg.norm(away, axis=1, keepdims=True)


def at(scene: Scene, points: ArrayLike) -> Array:
    return value(Terms.of(scene), points)


def test_every_figure_is_there_and_the_chain() -> None:
    assert sorted(re.match(r"(fig\d\d|section-6)-", preset.name)[1] for preset in FIGURES) == [  # type: ignore[index]
        *(f"fig{number:02d}" for number in range(1, 20)),
        "section-6",
    ]


@each
def test_is_told_in_two_sentences(preset: Builtin) -> None:
    assert len(re.findall(r"[.!?](?= [A-Z]|$)", preset.description)) == 2


@each
def test_has_sweeps_that_can_be_run(preset: Builtin) -> None:
    scene = load(preset.path)
    assert scene.animations
    for animation in scene.animations:
        assert animation["duration"] > 0
        assert animation["easing"] in ("linear", "smooth")
        assert animation["repeat"] in ("once", "loop", "ping-pong")
        assert len({len(sweep["values"]) for sweep in animation["sweeps"]}) == 1
        for sweep in animation["sweeps"]:
            assert sweep["scale"] in ("linear", "log")
            assert sweep["scale"] == "linear" or min(sweep["values"]) > 0
            assert len(sweep["values"]) >= 2
            assert [get(put(scene, sweep["path"], number), sweep["path"]) for number in sweep["values"]] == sweep["values"]
    assert len({animation["name"] for animation in scene.animations}) == len(scene.animations)


@pytest.mark.parametrize("number", [3, 4, 7, 8, 9, 11, 12, 13])
def test_frames_are_orthonormal(number: int) -> None:
    """A.A = B.B = C.C = D.D = 1 and every other product 0 (eqs. 38, 41); figure 13 is a slice at t = 0 and needs no D."""
    scene = figure(number)
    frame = np.array([[*strip.normal[: scene.dimension], strip.slice] for strip in scene.shapes[0].strips])
    frame = frame[:, np.any(frame != 0, axis=0)]
    assert frame.shape[1] == scene.dimension + (number != 13)
    np.testing.assert_allclose(frame.T @ frame, np.eye(frame.shape[1]), rtol=0, atol=1e-12)


@pytest.mark.parametrize("number", [3, 7, 9, 11, 13])
def test_gamma_2_is_a_sphere_of_radius_sqrt_of_1_less_t_squared(number: int) -> None:
    scene = stage_where(number, "gamma", 2)
    points = spread(100, scene.dimension) * sqrt(1 - scene.slice**2)
    np.testing.assert_allclose(at(scene, points), 0, atol=1e-12)


def test_figure_1_and_2_are_superquadrics() -> None:
    for stage in stages(figure(1)):
        e = 1 / get(stage, "gamma")
        assert area(stage) == pytest.approx(4 * gamma(1 + e) ** 2 / gamma(1 + 2 * e), rel=0.01)
    for stage in stages(figure(2)):
        e = 1 / get(stage, "gamma")
        volume = 8 * gamma(1 + e) ** 3 / gamma(1 + 3 * e)
        assert report(solid(stage))["volume"] == pytest.approx(volume, rel=0.01 if e <= 1 else 0.05)


@pytest.mark.parametrize("number", [3, 4, 7, 8, 9])
def test_triangles_and_hexagons_are_cuts_through_the_superquadric(number: int) -> None:
    """Three strips over the plane are the body of figure 2, cut across (1, 1, 1) at the distance t."""
    for stage in stages(figure(number)):
        body = put(figure(2), "gamma", get(stage, "gamma"))
        uv = default_rng(3).uniform(-1.5, 1.5, (50, 2))
        h = np.column_stack([uv, np.ones(50)]) @ planes(stage).T
        np.testing.assert_allclose(h.sum(axis=1), sqrt(3) * stage.slice, atol=1e-12)
        np.testing.assert_allclose(at(stage, np.column_stack([uv, np.zeros(50)])), at(body, h), atol=1e-9)


@pytest.mark.parametrize("number", [3, 7])
def test_figures_3_and_7_go_from_a_triangle_to_one_twice_as_long(number: int) -> None:
    first, *_, last = stages(figure(number))
    limit = put(first, "slice", 1 / sqrt(3))
    for hull, side in ((inner(limit), sqrt(2)), (outer(limit), 2 * sqrt(2))):
        assert counts(hull) == (3, 3)
        assert hull.volume == pytest.approx(sqrt(3) / 4 * side**2)
    assert inner(first).volume == pytest.approx(inner(limit).volume, rel=0.03)
    assert area(last) == pytest.approx(outer(limit).volume, rel=0.03)


def test_figure_4_is_a_triangle_a_hexagon_and_the_dual_triangle() -> None:
    bottom, middle, top = map(outer, stages(figure(4)))
    assert [counts(hull)[0] for hull in (bottom, middle, top)] == [3, 6, 3]
    assert alike(bottom.points, -top.points)
    assert middle.volume == pytest.approx(3 * sqrt(3))


def test_figure_5_is_bounded_by_the_triangle_of_its_strips() -> None:
    every = stages(figure(5))
    corners = {tuple(corner) for corner in (outer(every[0]).points + 0.0).tolist()}
    assert corners == {(-1.0, 0.0), (1.0, 0.0), (-1.0, 2.0)}
    areas = [area(stage) for stage in every]
    assert all(smaller < larger for smaller, larger in pairwise(areas))
    assert areas[-1] == pytest.approx(2, rel=0.03)
    # 2 x^2 + 2 x y + 2 y^2 - 2 y + 1 = 1 is an ellipse about (-1/3, 2/3), where the left side is 1/3
    assert areas[0] == pytest.approx(pi * (2 / 3) / sqrt(3), rel=1e-3)


def test_figure_6_presses_one_side_flat_at_a_time() -> None:
    beside = [(-0.95, 1.5, 0.0), (0.4, 0.05, 0.0), (0.45, 0.45, 0.0)]
    flat = np.array([at(stage, beside) > 0 for stage in stages(figure(6))])
    np.testing.assert_array_equal(flat, [[True, False, False], [False, True, False], [False, False, True], [False] * 3])


@pytest.mark.parametrize("number", [8, 12])
def test_the_far_side_of_the_slice_has_the_dual(number: int) -> None:
    every = stages(figure(number))
    assert [stage.slice for stage in every] == [-stage.slice for stage in reversed(every)]
    hulls = list(map(inner, every))
    for near, far in zip(hulls, reversed(hulls), strict=True):
        assert alike(near.points, -far.points)


def test_figure_8_has_a_regular_hexagon_half_way() -> None:
    middle = inner(stage_where(8, "slice", 0))
    np.testing.assert_allclose(np.linalg.norm(middle.points, axis=1), 1 / sqrt(2))
    assert counts(middle) == (6, 6)
    assert middle.volume == pytest.approx(3 * sqrt(3) / 4)


def test_figure_9_doubles_its_hexagon_by_way_of_two_circles() -> None:
    small, large = inner(figure(9)), outer(figure(9))
    assert counts(small) == counts(large) == (6, 6)
    assert alike(2 * small.points, large.points)
    for exponent, radius in ((2, 1.0), (4, 2**0.25)):
        np.testing.assert_allclose(at(put(figure(9), "gamma", exponent), radius * spread(50, 2)), 0, atol=1e-12)


@pytest.mark.parametrize("number", [10, 14])
def test_assortments_stand_apart_and_no_superquadric_is_among_them(number: int) -> None:
    scene = figure(number)
    assert all(len(shape.strips) > scene.dimension for shape in scene.shapes)
    for stage in stages(scene):
        mesh = polygonize(stage, 96, shading=False)
        assert (pieces(mesh), report(mesh)["euler_number"]) == (6, 12)


def test_figure_11_is_a_tetrahedron_a_sphere_and_a_truncated_tetrahedron() -> None:
    first, *_, last = stages(figure(11))
    limit = inner(put(first, "slice", 0.5))
    assert counts(limit) == (4, 4)
    assert limit.volume == pytest.approx(1 / 3)
    assert 0.49 <= first.slice < 0.5
    assert report(solid(first))["volume"] == pytest.approx(inner(first).volume, rel=0.005)
    ball = stage_where(11, "gamma", 2)
    assert report(solid(ball))["volume"] == pytest.approx(4 / 3 * pi * (sqrt(3) / 2) ** 3, rel=0.03)
    assert counts(outer(last)) == (12, 8)
    assert report(solid(last))["volume"] == pytest.approx(outer(last).volume, rel=0.03)


def test_figure_12_is_a_cuboctahedron_half_way() -> None:
    middle = stage_where(12, "slice", 0)
    assert counts(inner(middle)) == (12, 14)
    assert inner(middle).volume == pytest.approx(5 / 6)
    for stage in stages(figure(12)):
        assert report(solid(stage))["volume"] == pytest.approx(inner(stage).volume, rel=0.005)


def test_figure_13_is_an_icosidodecahedron_a_sphere_and_a_dodecahedron() -> None:
    first, *_, last = stages(figure(13))
    assert counts(inner(first)) == (30, 32)
    assert report(solid(first))["volume"] == pytest.approx(inner(first).volume, rel=0.005)
    assert report(solid(stage_where(13, "gamma", 2)))["volume"] == pytest.approx(4 / 3 * pi, rel=0.005)
    assert counts(outer(last)) == (20, 12)
    assert report(solid(last))["volume"] == pytest.approx(outer(last).volume, rel=0.03)


def test_figure_15_is_a_head_of_five_strips() -> None:
    (head,) = figure(15).shapes
    normals = np.array([strip.normal for strip in head.strips])
    np.testing.assert_array_equal(normals[:3], np.eye(3))
    assert len(normals) == 5
    assert not np.any(normals[3:, 0])  # left and right are alike
    assert [get(stage, "view.camera.azimuth") for stage in stages(figure(15))] == [0, 30, 90]


def test_figure_15_has_a_chin_a_throat_and_a_nape() -> None:
    """It looks along -y: depths are from the foremost to the hindmost point of the profile at a height, x = 0."""
    y = np.linspace(-1.2, 1.2, 481)

    def depth(z: float) -> tuple[float, float]:
        inside = y[at(figure(15), np.column_stack([np.zeros_like(y), y, np.full_like(y, z)])) > 0]
        return float(inside[0]), float(inside[-1])

    (face, skull), (chin, _), (throat, nape) = depth(0.0), depth(-0.9), depth(-1.2)
    assert chin < throat - 0.2
    assert nape < skull - 0.3
    assert face < chin
    points = solid(figure(15)).vertices
    neck = points[points[:, 2] < -1.2]
    assert np.ptp(neck[:, 0]) < 0.6 * np.ptp(points[:, 0])


@pytest.mark.parametrize("number", [16, 17, 18])
def test_landscapes_are_the_sum_as_the_paper_has_it(number: int) -> None:
    """sum_k c_k exp(-H_k) = w (eq. 44): no constant, no hardness, and hills of height 1."""
    scene = figure(number)
    assert {(shape.hardness, shape.constant, abs(shape.coefficient)) for shape in scene.shapes} == {(1.0, 0.0, 1.0)}
    assert all(0 < stage.level < 1 for stage in stages(scene))


def test_figure_16_is_the_hill_of_its_hyperquadric() -> None:
    points = default_rng(2).uniform(-2, 2, (50, 2))
    h = np.column_stack([points, np.ones(50)]) @ planes(figure(16)).T
    exponents = [strip.gamma for strip in figure(16).shapes[0].strips]
    hill = at(figure(16), np.column_stack([points, np.zeros(50)])) + figure(16).level
    np.testing.assert_allclose(hill, np.exp(-np.sum(np.abs(h) ** exponents, axis=1)), atol=1e-15)


def test_figure_17_joins_two_shapes_to_one() -> None:
    pieces = [len(outline(stage, precision=1e-3).curves) for stage in stages(figure(17))]
    assert pieces == [2, 1, 1, 1]


def test_figure_18_has_a_dent_at_every_stage() -> None:
    whole = figure(18).changed(shapes=figure(18).shapes[:1])
    for stage in stages(figure(18)):
        dented, plain = outline(stage, precision=1e-3), outline(whole.changed(level=stage.level), precision=1e-3)
        assert dented.area < 0.95 * ConvexHull(dented.polygons()[0]).volume
        assert plain.area > 0.995 * ConvexHull(plain.polygons()[0]).volume


def test_figure_19_is_one_elliptic_shape_and_two_orthogonal_hyperboloids() -> None:
    body, *holes = figure(19).shapes
    assert body.coefficient > 0
    assert all(strip.sign == 1 for strip in body.strips)
    assert [hole.coefficient < 0 for hole in holes] == [True, True]
    (one,), (other,) = ([strip.normal for strip in hole.strips if strip.sign < 0] for hole in holes)
    assert np.dot(one, other) == 0
    assert [report(solid(stage))["euler_number"] for stage in stages(figure(19))] == [2, 2, -2]


def test_the_chain_is_five_rings_each_linked_with_the_next_alone() -> None:
    chain = load(next(preset.path for preset in FIGURES if preset.name == "section-6-chain"))
    rings = [_middle(chain, index) for index in range(0, len(chain.shapes), 2)]
    assert len(rings) == 5
    assert all(np.all(at(chain, ring) > 0) for ring in rings)
    links = [[abs(round(_linking(a, b))) for b in rings if b is not a] for a in rings]
    assert links == [[1, 0, 0, 0], [1, 1, 0, 0], [0, 1, 1, 0], [0, 0, 1, 1], [0, 0, 0, 1]]
    meshes = [polygonize(stage, 96, shading=False) for stage in stages(chain)]
    assert [(pieces(mesh), report(mesh)["euler_number"]) for mesh in meshes] == [(5, 0), (5, 0), (1, -8)]


def _middle(chain: Scene, index: int) -> Array:
    """The oval along the middle of a link, half way from its hole's rim to its own, as points (200, 3) in the world."""
    link, hole = chain.shapes[index : index + 2]
    half = [(a.half_width + b.half_width) / 2 for a, b in zip(link.strips[:2], hole.strips[:2], strict=True)]
    around = np.linspace(0, 2 * pi, 200, endpoint=False)
    x, y = half[0] * np.cos(around), half[1] * np.sin(around)
    turn = 2 * np.arctan2(link.transform.rotation[0], link.transform.rotation[3])
    return np.column_stack([x, y * np.cos(turn), y * np.sin(turn)]) + link.transform.translation


def _linking(one: Array, other: Array) -> float:
    """How often two closed chains of points (n, 3) wind through each other (Gauss's integral)."""
    steps, middles = zip(*((np.roll(c, -1, 0) - c, (np.roll(c, -1, 0) + c) / 2) for c in (one, other)), strict=True)
    apart = middles[0][:, None] - middles[1]
    across = np.cross(steps[0][:, None], steps[1])
    return float(np.sum(np.sum(apart * across, axis=-1) / np.linalg.norm(apart, axis=-1) ** 3) / (4 * pi))
