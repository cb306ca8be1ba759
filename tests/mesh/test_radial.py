"""Quads over star-shaped bodies: closed, on the surface, mirrored to the bit, unfolded without overlap, read back as quads."""

from __future__ import annotations

import io
from collections import Counter
from functools import cache
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from hqmodel.field import Terms, first_hits, near_linear_gradient, region
from hqmodel.mesh import FORMATS, Mesh, MeshError, Quads, fitted, radial_quads, report, sized, write
from hqmodel.model import Scene, Shape, Strip, Transform

from ..cases import case

STAR_SHAPED = ["astroid", "composite_1", "convex_2", "cylinder", "mirrored", "tetrahedron", "thin_plate"]
AROUND = 48
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@cache
def body(name: str, around: int = AROUND) -> Mesh:
    return radial_quads(case(name).scene, around)


def quads(mesh: Mesh) -> Quads:
    assert mesh.quads is not None
    return mesh.quads


def written(mesh: Mesh, suffix: str) -> bytes:
    stream = io.BytesIO()
    write(mesh, stream, suffix)
    return stream.getvalue()


@pytest.mark.parametrize("name", STAR_SHAPED)
def test_closed_and_all_quads(name: str) -> None:
    mesh, side = body(name), AROUND // 4
    assert report(mesh)["watertight"]
    assert report(mesh)["euler_number"] == 2
    corners = quads(mesh).corners
    assert corners.shape == (6 * side**2, 4)
    assert len(mesh.vertices) == 6 * side**2 + 2
    edges = Counter(zip(corners.ravel().tolist(), np.roll(corners, -1, axis=1).ravel().tolist(), strict=True))
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges)


@pytest.mark.parametrize("name", STAR_SHAPED)
def test_every_vertex_is_on_the_surface(name: str) -> None:
    mesh, terms = body(name), Terms.of(case(name).scene)
    linear, slope = near_linear_gradient(terms, mesh.vertices)
    size = np.maximum(np.linalg.norm(slope, axis=1), 1.0)
    assert np.max(np.abs(linear) / size) < 1e-9 * np.max(np.ptp(mesh.vertices, axis=0))


def test_the_triangles_are_the_quads_halves() -> None:
    mesh = body("mirrored")
    count = len(quads(mesh).corners)
    for half, other, corners in zip(mesh.faces[:count], mesh.faces[count:], quads(mesh).corners, strict=True):
        assert set(half) | set(other) == set(corners)
        diagonal = [mesh.vertices[pair[0]] - mesh.vertices[pair[1]] for pair in (sorted(set(half) & set(other)), corners[:3:2])]
        assert np.linalg.norm(diagonal[0]) <= np.linalg.norm(diagonal[1]) * (1 + 1e-12)


def test_a_ball_converges_as_the_square_of_the_grid() -> None:
    missing = [4 / 3 * pi - report(body("sphere", around))["volume"] for around in (16, 32, 64)]
    assert missing[2] > 0
    np.testing.assert_allclose([missing[0] / missing[1], missing[1] / missing[2]], 4, rtol=0.1)


def test_normals_and_the_error_told_are_true() -> None:
    mesh, terms = body("superquadric"), Terms.of(case("superquadric").scene)
    slope = near_linear_gradient(terms, mesh.vertices)[1]
    outward = -slope / np.linalg.norm(slope, axis=1, keepdims=True)
    np.testing.assert_allclose(np.asarray(mesh.normals), outward, atol=1e-6)
    middles = mesh.vertices[mesh.faces].mean(axis=1)
    away = np.linalg.norm(middles, axis=1)
    below = 3 - first_hits(terms, region(case("superquadric").scene), 3 * middles / away[:, None], -middles) - away
    assert mesh.surface_error is not None
    assert 0.5 * below.max() < mesh.surface_error <= 1.01 * below.max()


@pytest.mark.parametrize(("name", "axes"), [("mirrored", (0, 1)), ("astroid", (0, 1, 2)), ("thin_plate", (0, 1, 2))])
def test_the_mesh_is_its_own_mirror_image_to_the_bit(name: str, axes: tuple[int, ...]) -> None:
    mesh = body(name)
    triangles = {frozenset(map(tuple, corners)) for corners in mesh.vertices[mesh.faces].tolist()}
    for axis in axes:
        flip = np.where(np.arange(3) == axis, -1.0, 1.0)
        image = {frozenset(map(tuple, corners)) for corners in ((mesh.vertices * flip + 0.0)[mesh.faces]).tolist()}
        assert image == triangles


def test_the_cross_has_no_overlap_and_two_ends_that_meet() -> None:
    mesh, side = body("convex_2"), AROUND // 4
    uv, places = quads(mesh).uv, quads(mesh).uv_corners
    assert np.all((uv >= 0) & (uv <= 1))
    a, b, c, d = (uv[places[:, i]] for i in range(4))
    turn = (c - a)[:, 0] * (d - b)[:, 1] - (c - a)[:, 1] * (d - b)[:, 0]
    np.testing.assert_allclose(turn / 2, 1 / (4 * side) ** 2, rtol=1e-9)
    middles = np.floor(uv[places].mean(axis=1) * 4 * side).astype(int)
    assert len(np.unique(middles, axis=0)) == len(places)
    pairs = np.unique(np.column_stack([places.ravel(), quads(mesh).corners.ravel()]), axis=0)
    assert len(pairs) == len(uv)  # a place belongs to one vertex
    vertex = dict(pairs.tolist())
    left, right = (sorted(np.flatnonzero(uv[:, 0] == end), key=lambda i: float(uv[i, 1])) for end in (0.0, 1.0))
    assert len(left) == side + 1
    assert [vertex[i] for i in left] == [vertex[i] for i in right]


@pytest.mark.parametrize("up", ["y", "z"])
def test_another_reads_quads_and_their_places_from_obj(up: str, tmp_path: Path) -> None:
    mesh = fitted(sized(body("cylinder"), 50.0), ".obj", up=up)  # type: ignore[arg-type]
    path = tmp_path / "body.obj"
    path.write_bytes(written(mesh, ".obj"))
    lines = [line.split()[1:] for line in path.read_text().splitlines() if line.startswith("f ")]
    corners = np.array([[corner.split("/") for corner in line] for line in lines], dtype=int) - 1
    assert np.array_equal(corners[:, :, 0], quads(mesh).corners)
    assert np.array_equal(corners[:, :, 1], quads(mesh).uv_corners)
    assert np.array_equal(corners[:, :, 2], quads(mesh).corners)
    loaded: Any = trimesh.load(path, force="mesh", process=False)
    ours = np.unique(np.column_stack([quads(mesh).corners.ravel(), quads(mesh).uv_corners.ravel()]), axis=0)
    pairs = np.column_stack([mesh.vertices[ours[:, 0]], quads(mesh).uv[ours[:, 1]]])
    theirs = np.column_stack([loaded.vertices, loaded.visual.uv])
    assert {tuple(row) for row in theirs.round(4).tolist()} == {tuple(row) for row in pairs.round(4).tolist()}
    loaded.merge_vertices(merge_tex=True, merge_norm=True)
    assert loaded.is_watertight
    assert loaded.volume == pytest.approx(report(mesh)["volume"], rel=5e-3)  # it cuts quads its own way


def test_obj_without_normals_keeps_the_places() -> None:
    mesh = body("sphere", 8)
    bare = Mesh(mesh.vertices, mesh.faces, quads=mesh.quads)
    face = next(line for line in written(bare, ".obj").decode().splitlines() if line.startswith("f "))
    assert [len(corner.split("/")) for corner in face.split()[1:]] == [2] * 4


@pytest.mark.parametrize("suffix", sorted(set(FORMATS) - {".obj"}))
def test_formats_without_quads_get_the_triangles(suffix: str) -> None:
    loaded: Any = trimesh.load(io.BytesIO(written(fitted(body("cylinder"), suffix), suffix)), file_type=suffix[1:], force="mesh")
    assert loaded.is_watertight
    assert len(loaded.faces) == len(body("cylinder").faces)
    assert loaded.volume == pytest.approx(report(body("cylinder"))["volume"], rel=1e-5)


def test_a_body_is_solved_where_it_stands() -> None:
    strips = tuple(Strip(normal=axis, gamma=3.0) for axis in AXES)
    placed = Transform(translation=(40.0, -7.0, 3.0), scale=(2.0, 1.0, 0.5))
    mesh = radial_quads(Scene(shapes=(Shape(strips=strips, transform=placed),)), AROUND)
    about = radial_quads(Scene(shapes=(Shape(strips=strips, transform=Transform(scale=(2.0, 1.0, 0.5))),)), AROUND)
    np.testing.assert_allclose(mesh.vertices - (40.0, -7.0, 3.0), about.vertices, atol=1e-11)


@pytest.mark.parametrize(
    ("scene", "message"),
    [
        (Scene(shapes=()), "no surface: the field is below its level everywhere"),
        (Scene(shapes=(Shape(strips=(Strip(normal=AXES[0]), Strip(normal=AXES[1]))),)), "expected a body that ends by itself"),
        (Scene(dimension=2, shapes=(Shape(strips=(Strip(normal=AXES[0]), Strip(normal=AXES[1]))),)), "expected a body that ends"),
        (case("two_holes").scene, "expected a body all seen from one point inside, got one turned away from"),
    ],
)
def test_what_has_no_radial_grid_is_refused(scene: Scene, message: str) -> None:
    with pytest.raises(MeshError, match=message) as told:
        radial_quads(scene, 16)
    assert "\n" not in str(told.value)


def test_whoever_is_told_of_progress_can_stop_it() -> None:
    told: list[float] = []
    radial_quads(case("sphere").scene, 16, lambda share, doing: told.append(share))
    assert told == sorted(told)
    assert told[-1] == 1.0

    def stop(share: float, doing: str) -> None:
        raise InterruptedError

    with pytest.raises(InterruptedError):
        radial_quads(case("sphere").scene, 16, stop)
