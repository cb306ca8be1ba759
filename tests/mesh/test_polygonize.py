"""Meshes: the reference volumes, watertight whatever comes, mirrored to the bit, caps, tips, thin parts."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from numpy.random import default_rng
from numpy.typing import NDArray

from hqmodel.field import Terms, first_hits, log_gradient, log_ratio, region
from hqmodel.mesh import Mesh, MeshError, polygonize, report
from hqmodel.model import Group, Scene, Shape, Strip, Transform

from ..cases import NAMES, case
from ..gpu.scenes import random_scene
from .volumes import scene_of

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def tetrahedral(gamma: float, t: float) -> Scene:
    """A slice through the four-dimensional shape of figures 11 and 12; at gamma 1 and t 1/2 H is 1 throughout a tetrahedron."""
    rows = ((0.5, 0.5, 0.5), (0.5, -0.5, -0.5), (-0.5, 0.5, -0.5), (-0.5, -0.5, 0.5))
    return Scene(slice=t, shapes=(Shape(strips=tuple(Strip(normal=row, slice=0.5, gamma=gamma) for row in rows)),))


def ball(away: float) -> Scene:
    strips = tuple(Strip(normal=n) for n in (X, Y, Z))
    return Scene(shapes=(Shape(strips=strips, transform=Transform(translation=(away, 0.0, 0.0))),))


def distance(scene: Scene, mesh: Mesh) -> NDArray[np.float64]:
    """Of each vertex from the surface, to first order."""
    ratio, slope = log_gradient(Terms.of(scene), mesh.vertices)
    result: NDArray[np.float64] = np.abs(ratio) / np.linalg.norm(slope, axis=1)
    return result


def sound(mesh: Mesh) -> None:
    """Closed, two triangles to every edge in opposite directions, no vertex twice or unused, no face without area."""
    assert report(mesh)["watertight"]
    assert len(np.unique(mesh.vertices, axis=0)) == len(mesh.vertices)
    assert np.array_equal(np.unique(mesh.faces), np.arange(len(mesh.vertices)))
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    longest = np.maximum.reduce([np.linalg.norm(p - q, axis=1) for p, q in ((a, b), (b, c), (c, a))])
    height = np.linalg.norm(np.cross(b - a, c - a), axis=1) / longest
    assert np.min(height) > 1e-8 * np.max(np.ptp(mesh.vertices, axis=0))


@pytest.mark.parametrize("name", NAMES)
def test_reference(name: str) -> None:
    here = case(name)
    mesh = polygonize(here.scene, 160)
    sound(mesh)
    measured = report(mesh)
    tolerance = (0.02 if name == "astroid" else 0.004) + here.truth["volume_tolerance"]
    assert abs(measured["volume"] / here.truth["volume"] - 1) < tolerance
    side = float(np.max(np.ptp(mesh.vertices, axis=0)))
    assert np.max(distance(here.scene, mesh)) < 7e-5 * side
    assert mesh.normals is not None
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-5)


@pytest.mark.parametrize("changes", [{"coefficient": 8.0}, {"constant": 5.0}, {"mirror": ("x",), "coefficient": 3.0}])
def test_a_thin_plate_however_far_the_field_is_above_its_level(changes: dict[str, Any]) -> None:
    strips = [Strip(normal=n, half_width=w, gamma=60.0) for n, w in (((0.8, 0.6, 0.0), 0.04), ((-0.6, 0.8, 0.0), 1.0), (Z, 1.0))]
    scene = Scene(shapes=(Shape(strips=tuple(strips), **changes),))
    mesh = polygonize(scene, 96)
    sound(mesh)
    assert np.max(distance(scene, mesh)) < 7e-5 * 2


@pytest.mark.parametrize("seed", range(24))
def test_random_scenes(seed: int) -> None:
    rng = default_rng(100 + seed)
    scene = random_scene(rng, shapes=1 + seed % 5, exponents=(0.5, 0.8, 1.0, 1.3, 2.0, 4.0, 12.0, 60.0, 400.0))
    if scene.bounds is None and not region(scene).bounded:
        scene = scene.changed(bounds=((-2.0, -2.0, -2.0), (2.0, 2.0, 2.0)))
    if region(scene).empty:
        with pytest.raises(MeshError, match="no surface"):
            polygonize(scene, 48)
        return
    mesh = polygonize(scene, 48)
    sound(mesh)
    assert report(mesh)["volume"] > 0


@pytest.mark.parametrize("name", NAMES)
def test_reduced(name: str) -> None:
    here = case(name)
    mesh = polygonize(here.scene, 96, target_faces=3000)
    sound(mesh)
    measured = report(mesh)
    assert 2900 < measured["faces"] <= 3000
    assert measured["euler_number"] == report(polygonize(here.scene, 96))["euler_number"]
    assert abs(measured["volume"] / here.truth["volume"] - 1) < 0.02
    side = float(np.max(np.ptp(mesh.vertices, axis=0)))
    assert np.max(distance(here.scene, mesh)) < 7e-5 * side
    assert mesh.normals is not None
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-5)


def test_caps_stay_flat_when_reduced() -> None:
    pipe = Scene(shapes=(Shape(strips=(Strip(normal=X), Strip(normal=Y))),), bounds=((-2, -2, -1), (2, 2, 1.5)))
    mesh = polygonize(pipe, 90, target_faces=500)
    sound(mesh)
    measured = report(mesh)
    assert measured["volume"] == pytest.approx(np.pi * 2.5, rel=0.02)
    assert (measured["bounds"][0][2], measured["bounds"][1][2]) == (-1.0, 1.5)
    assert mesh.normals is not None
    on_top = mesh.vertices[:, 2] == 1.5
    assert np.all(mesh.normals[on_top, 2] > 0.7)


@pytest.mark.parametrize("turn", [0.0, 0.6])
def test_creases_are_sharp(turn: float) -> None:
    """A block with hardly any rounding: its faces flat, its edges where they are, whichever way it is turned."""
    rotation = (np.sin(turn / 2) * 0.6, 0.0, np.sin(turn / 2) * 0.8, np.cos(turn / 2))
    strips = tuple(Strip(normal=n, gamma=400) for n in (X, Y, Z))
    block = Scene(shapes=(Shape(strips=strips, transform=Transform(rotation=rotation)),))
    mesh = polygonize(block, 64)
    sound(mesh)
    # a block chamfered as marching cubes leaves it, at most by half a cell, would lack some 12 * 2 * (cell / 2)^2 / 4
    assert 8 - report(mesh)["volume"] < 0.003
    corners = mesh.vertices[mesh.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    h = np.stack([Terms.of(block).normal @ normal for normal in across / np.linalg.norm(across, axis=1, keepdims=True)])
    area = np.linalg.norm(across, axis=1)
    assert np.sum(area[np.max(np.abs(h), axis=1) > 0.999]) > 0.96 * np.sum(area)


@pytest.mark.parametrize("thick", [0.02, 0.04])
@pytest.mark.parametrize("turn", [0.3, 0.6, 2.0])
def test_acute_rims_of_thin_plates_are_whole(turn: float, thick: float) -> None:
    """Plates one and two cells thick, whose sides slant: their volume in closed form, that of a ball of a p-norm."""
    rotation = (np.sin(turn / 2) * 0.6, np.sin(turn / 2) * 0.48, np.sin(turn / 2) * 0.64, np.cos(turn / 2))
    sides = [((1.0, 0.0, 1.5), 0.5), ((0.0, 1.0, -1.0), 1.0), (Z, thick / 2)]
    strips = tuple(Strip(normal=n, half_width=width, gamma=60) for n, width in sides)
    mesh = polygonize(Scene(shapes=(Shape(strips=strips, transform=Transform(rotation=rotation)),)), 100)
    sound(mesh)
    assert report(mesh)["volume"] == pytest.approx(2 * thick * math.gamma(1 + 1 / 60) ** 3 / math.gamma(1 + 3 / 60), rel=1e-3)


@pytest.mark.parametrize("name", ["mirrored", "two_holes", "sphere", "astroid", "cuboctahedron"])
@pytest.mark.parametrize("target", [None, 1000])
def test_a_mirrored_scene_is_its_own_image_to_the_bit(name: str, target: int | None) -> None:
    mesh = polygonize(case(name).scene, 26, target_faces=target)
    for axis in (0, 1) if name == "mirrored" else (0, 1, 2):
        image = mesh.vertices.copy()
        image[:, axis] *= -1
        order, mirrored = np.lexsort(mesh.vertices.T), np.lexsort((image + 0.0).T)
        assert np.array_equal(mesh.vertices[order], (image + 0.0)[mirrored])
        same = np.empty(len(order), dtype=np.int64)
        same[mirrored] = order
        flipped = {tuple(np.roll(face, -int(np.argmin(face)))) for face in same[mesh.faces][:, ::-1]}
        assert flipped == {tuple(np.roll(face, -int(np.argmin(face)))) for face in mesh.faces}


def test_the_same_scene_gives_the_same_bytes() -> None:
    first, second = polygonize(case("composite_0").scene, 80), polygonize(case("composite_0").scene, 80)
    assert first.vertices.tobytes() == second.vertices.tobytes()
    assert first.faces.tobytes() == second.faces.tobytes()


def lenses() -> Scene:
    """Four that cross, thinner than a cell at their rims: so steep that beside one the others are nothing."""
    turned = ((0.8, 0.36, 0.48), (-0.6, 0.48, 0.64), (0.0, -0.8, 0.6))
    strips = (Strip(normal=n, half_width=w, gamma=1.3, group="lens") for n, w in zip(turned, (0.02, 0.6, 0.9), strict=True))
    groups = {"lens": Group(gamma=12.0)}
    shape = Shape(strips=tuple(strips), groups=groups, mirror=("x", "y"), transform=Transform(translation=(0.1, 0.2, 0.1)))
    return Scene(shapes=(shape,))


@pytest.mark.parametrize("name", ["composite_1", "convex_0", "truncated_tetrahedron", "lenses"])
def test_runs_of_blocks_leave_no_trace(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same triangles however the blocks are parted, as a set, to the last bit."""
    meshes = []
    for run in (40, 400, 3000, 10**6):
        monkeypatch.setattr("hqmodel.mesh.build.RUN", run)
        monkeypatch.setattr("hqmodel.mesh.build.LEAST", 1)
        meshes.append(polygonize(lenses() if name == "lenses" else case(name).scene, 70))
    corners = [{face.tobytes() for face in mesh.vertices[mesh.faces]} for mesh in meshes]
    assert len(corners[0]) == len(meshes[0].faces)
    assert corners[0] == corners[1] == corners[2] == corners[3]


def test_nothing_is_missed_that_a_dense_look_finds(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every change of sign between neighbouring nodes of the grid has its vertex, before creases are put back; and little else:
    what is thinner than a cell."""
    monkeypatch.setattr("hqmodel.mesh.finish.creased", lambda *_: None)
    scene = case("composite_2").scene
    mesh = polygonize(scene, 48)
    where = region(scene)
    step = np.max(where.size) / 48
    counts = np.maximum(8, np.ceil(where.size / step - 1e-9)).astype(int)
    nodes = [low + (np.arange(n + 2) - 0.5) * (size / n) for low, size, n in zip(where.low, where.size, counts, strict=True)]
    inside = log_ratio(Terms.of(scene), np.stack(np.meshgrid(*nodes, indexing="ij"), axis=-1)) > 0
    crossings = sum(int(np.count_nonzero(np.diff(inside, axis=axis))) for axis in range(3))
    assert len(mesh.vertices) >= crossings
    assert len(mesh.vertices) - crossings < 0.005 * crossings


def test_caps_are_flat_and_closed() -> None:
    pipe = Scene(shapes=(Shape(strips=(Strip(normal=X), Strip(normal=Y))),), bounds=((-2, -2, -1), (2, 2, 1.5)))
    mesh = polygonize(pipe, 90)
    sound(mesh)
    measured = report(mesh)
    assert measured["volume"] == pytest.approx(np.pi * 2.5, rel=2e-3)
    assert measured["bounds"][0][2] == -1.0
    assert measured["bounds"][1][2] == 1.5
    assert measured["euler_number"] == 2
    assert np.count_nonzero(mesh.vertices[:, 2] == 1.5) > 100


def test_cells_are_counted_along_the_body_where_its_bounds_are_wide() -> None:
    scene = scene_of(41)  # which bounds put into a box three times as long as it is
    mesh = polygonize(scene, 64, shading=False)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    assert np.max(region(scene).size) > 2 * np.max(high - low)
    margin = 0.02 * np.max(high - low)
    close = scene.changed(bounds=(tuple((low - margin).tolist()), tuple((high + margin).tolist())))
    assert len(mesh.faces) == pytest.approx(len(polygonize(close, 64, shading=False).faces), rel=0.15)


def test_bounds_that_slice_a_ball_in_half() -> None:
    mesh = polygonize(case("sphere").scene.changed(bounds=((-2, -2, 0), (2, 2, 2))), 100)
    sound(mesh)
    assert report(mesh)["volume"] == pytest.approx(2 / 3 * np.pi, rel=1e-3)


def test_a_flat_shape_becomes_a_plate() -> None:
    disc = Scene(dimension=2, shapes=(Shape(strips=(Strip(normal=X), Strip(normal=Y))),))
    mesh = polygonize(disc, 100)
    sound(mesh)
    thickness = float(np.ptp(mesh.vertices[:, 2]))
    assert thickness == pytest.approx(0.04, rel=0.05)
    assert report(mesh)["volume"] == pytest.approx(np.pi * thickness, rel=2e-3)


def test_cusps_end_in_their_tips() -> None:
    strips = tuple(Strip(normal=n, gamma=0.5) for n in (X, Y, Z))
    mesh = polygonize(Scene(shapes=(Shape(strips=strips),)), 80)
    sound(mesh)
    np.testing.assert_allclose(report(mesh)["bounds"], [[-1, -1, -1], [1, 1, 1]], atol=1e-6)


@pytest.mark.parametrize("shift", [0.0, 0.0123, 0.5])
def test_a_plate_thinner_than_a_cell_is_whole(shift: float) -> None:
    strips = Strip(normal=X, gamma=60.0), Strip(normal=Y, gamma=60.0), Strip(normal=Z, gamma=60.0, half_width=0.004)
    moved = Transform(translation=(0.0, 0.0, shift))
    mesh = polygonize(Scene(shapes=(Shape(transform=moved, strips=strips),)), 64)
    sound(mesh)
    assert report(mesh)["volume"] == pytest.approx(0.15978768902205062 / 5, rel=0.02)


def test_several_bodies_and_holes_are_kept() -> None:
    ball = tuple(Strip(normal=n) for n in (X, Y, Z))
    pair = [Shape(hardness=20.0, transform=Transform(translation=(d, 0.0, 0.0)), strips=ball) for d in (-1.5, 1.5)]
    assert report(polygonize(Scene(shapes=tuple(pair)), 64))["euler_number"] == 4
    assert report(polygonize(case("two_holes").scene, 64))["euler_number"] == -4


def test_the_stated_error_is_what_rays_find() -> None:
    """Rays through the middles of faces, straight at the surface, meet it no farther than the stated error."""
    for name in ("dodecahedron", "convex_1", "two_holes"):
        scene = case(name).scene
        mesh = polygonize(scene, 64)
        cell = float(np.max(np.ptp(mesh.vertices, axis=0))) / 64
        terms = Terms.of(scene)
        middles = mesh.vertices[mesh.faces].mean(axis=1)
        slopes = log_gradient(terms, middles)[1]
        outwards = -slopes / np.linalg.norm(slopes, axis=1, keepdims=True)
        free = log_ratio(terms, middles + cell * outwards) < 0
        hits = first_hits(terms, region(scene, terms), (middles + cell * outwards)[free], -outwards[free])
        found = np.abs(hits - cell)
        assert mesh.surface_error is not None
        assert 0.3 * np.nanmax(found) < mesh.surface_error < 1.5 * np.nanmax(found)


@pytest.mark.parametrize(
    ("scene", "message"),
    [
        (Scene(shapes=()), "no surface: there is no visible shape"),
        (tetrahedral(1.0, 0.5), "no surface: the field does not reach its level anywhere at this resolution"),
        (ball(1e12), "expected a body nearer to the origin, got one 2 long at a distance of 1e"),
        (case("sphere").scene.changed(level=9.0), "no surface: the field is below its level everywhere"),
        (Scene(shapes=(Shape(strips=(Strip(normal=X), Strip(normal=Y))),)), "bounds: expected a box to cut the body by"),
    ],
)
def test_what_has_no_mesh_says_so(scene: Scene, message: str) -> None:
    with pytest.raises(MeshError, match=message):
        polygonize(scene, 32)


def test_too_few_faces() -> None:
    with pytest.raises(MeshError, match="target faces: expected a whole number of at least 4, got 3"):
        polygonize(ball(0.0), 16, target_faces=3)


def test_faces_lie_on_both_sides_of_the_surface() -> None:
    """The faces of a ball enclose its volume, where those of one with all vertices on the sphere lack a share of 7e-5."""
    assert report(polygonize(ball(0.0), 160))["volume"] == pytest.approx(4 / 3 * np.pi, rel=3e-5)


@pytest.mark.parametrize("resolution", [0, 3, 2049])
def test_resolution_out_of_range(resolution: int) -> None:
    with pytest.raises(MeshError, match="resolution: expected a whole number from 4 to 2048"):
        polygonize(case("sphere").scene, resolution)


@pytest.mark.parametrize("reduced", [{}, {"target_faces": 500}, {"tolerance": 0.01}])
def test_progress_rises_and_its_exception_ends_the_work(reduced: dict[str, Any]) -> None:
    heard: dict[str, list[float]] = {}
    polygonize(case("sphere").scene, 64, lambda share, doing: heard.setdefault(doing, []).append(share), **reduced)
    told = [share for shares in heard.values() for share in shares]
    assert told == sorted(told)
    assert told[-1] == 1.0
    assert not reduced or len(set(heard["Reducing"])) > 5

    class Stop(Exception):
        pass

    def stop(share: float, doing: str) -> None:
        if share > 0:
            raise Stop

    with pytest.raises(Stop):
        polygonize(case("composite_0").scene, 128, stop)


@pytest.mark.parametrize("name", ["sphere", "tetra_sphere", "dodecahedron"])
def test_no_slivers_where_the_surface_is_smooth(name: str) -> None:
    mesh = polygonize(case(name).scene, 100)
    corners = mesh.vertices[mesh.faces]
    sides = np.roll(corners, -1, axis=1) - corners
    sides /= np.linalg.norm(sides, axis=2, keepdims=True)
    cosines = -np.einsum("fki,fki->fk", sides, np.roll(sides, -1, axis=1))
    assert np.degrees(np.arccos(np.max(cosines))) > 1


def test_reducing_can_be_stopped() -> None:
    class Stop(Exception):
        pass

    told: list[str] = []

    def stop(share: float, doing: str) -> None:
        told.append(doing)
        if told.count("Reducing") == 3:
            raise Stop

    with pytest.raises(Stop):
        polygonize(ball(0.0), 32, stop, target_faces=100)
