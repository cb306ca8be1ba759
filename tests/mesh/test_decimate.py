"""Decimation: targets met, always a surface of the same kind, creases, caps and mirror planes kept, vertices on the surface."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.random import default_rng
from numpy.typing import NDArray

from hqmodel.field import Terms, mirror_axes, region
from hqmodel.mesh import Mesh, MeshError, polygonize, report
from hqmodel.mesh.decimate import simplified
from hqmodel.mesh.mesh import Array, Triangles, reflected
from hqmodel.model import Scene, Shape, Strip, Transform

from ..cases import NAMES, case
from ..gpu.scenes import random_scene

Bools = NDArray[np.bool_]
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def box(gamma: float) -> Scene:
    return Scene(shapes=(Shape(strips=tuple(Strip(normal=n, gamma=gamma) for n in (X, Y, Z))),))


def sphere(resolution: int) -> Mesh:
    return polygonize(box(2.0), resolution, shading=False)


def onto_sphere(points: Array, held: Bools) -> Array:
    assert points.shape == held.shape
    placed: Array = points / np.linalg.norm(points, axis=1, keepdims=True)
    return placed


def torus(around: int, across: int) -> tuple[Array, Triangles]:
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    u, v = 2 * np.pi * i / around, 2 * np.pi * j / across
    ring = 1 + 0.4 * np.cos(v)
    a, b = i * across + j, (i + 1) % around * across + j
    c, d = (i + 1) % around * across + (j + 1) % across, i * across + (j + 1) % across
    faces = np.concatenate([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)]).reshape(-1, 3)
    return np.stack([ring * np.cos(u), ring * np.sin(u), 0.4 * np.sin(v)], axis=-1).reshape(-1, 3), faces.astype(np.int32)


def lattice(cubes: list[tuple[int, int, int]], steps: int) -> tuple[Array, Triangles]:
    """The outside of unit cubes, each side of them in steps by steps squares; cubes share vertices where they touch."""
    squares: list[list[tuple[int, ...]]] = []
    for corner in cubes:
        for axis in range(3):
            for side in (0, 1):
                if tuple(c + (2 * side - 1) * (i == axis) for i, c in enumerate(corner)) in cubes:
                    continue
                for u, v in np.ndindex(steps, steps):
                    ring = []
                    for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1))[:: 2 * side - 1]:
                        node = [steps * c for c in corner]
                        node[axis] += steps * side
                        node[(axis + 1) % 3] += u + du
                        node[(axis + 2) % 3] += v + dv
                        ring.append(tuple(node))
                    squares.append(ring)
    nodes, number = np.unique(np.array(squares).reshape(-1, 3), axis=0, return_inverse=True)
    corners = number.reshape(-1, 4)
    return nodes / steps, np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]).astype(np.int32)


def part(mesh: Mesh, axes: tuple[int, ...]) -> Triangles:
    """The faces where the coordinates along axes are positive."""
    faces = mesh.faces
    for axis in axes:
        faces = faces[np.max(mesh.vertices[:, axis][faces], axis=1) > 0]
    return faces


def whole(vertices: Array, faces: Triangles, axes: tuple[int, ...]) -> Mesh:
    mesh = Mesh(vertices, faces)
    for axis in axes:
        mesh = reflected(mesh, axis)
    return mesh


def free(mesh: Mesh) -> Bools:
    return np.zeros(mesh.vertices.shape, dtype=bool)


def bodies(mesh: Mesh) -> int:
    label = np.arange(len(mesh.vertices))
    while True:
        least = np.min(label[mesh.faces], axis=1)
        spread = label.copy()
        np.minimum.at(spread, mesh.faces, least[:, None])
        if np.array_equal(spread, label):
            return len(np.unique(label[mesh.faces]))
        label = spread


def sound(mesh: Mesh) -> None:
    """Every edge with one face in each direction, no face twice or without area, no vertex twice or unused."""
    start, end = mesh.faces.ravel(), np.roll(mesh.faces, -1, axis=1).ravel()
    there = np.stack([start, end], axis=1)
    assert len(np.unique(there, axis=0)) == len(there)
    assert np.array_equal(np.unique(there, axis=0), np.unique(there[:, ::-1], axis=0))
    assert len(np.unique(np.sort(mesh.faces, axis=1), axis=0)) == len(mesh.faces)
    assert np.array_equal(np.unique(mesh.faces), np.arange(len(mesh.vertices)))
    assert len(np.unique(mesh.vertices, axis=0)) == len(mesh.vertices)
    assert mesh.faces.dtype == np.int32
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    longest = np.maximum.reduce([np.linalg.norm(p - q, axis=1) for p, q in ((a, b), (b, c), (c, a))])
    assert np.min(np.linalg.norm(np.cross(b - a, c - a), axis=1) / longest**2) > 1e-7


def same_kind(result: Mesh, origin: Mesh) -> None:
    assert report(result)["euler_number"] == report(origin)["euler_number"]
    assert bodies(result) == bodies(origin)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("share", [0.6, 0.2])
def test_reference(name: str, share: float) -> None:
    mesh = polygonize(case(name).scene, 48, shading=False)
    target = int(share * len(mesh.faces))
    result = Mesh(*simplified(mesh.vertices, mesh.faces, target, free(mesh)))
    sound(result)
    same_kind(result, mesh)
    assert target - 1 <= len(result.faces) <= target
    assert report(result)["volume"] == pytest.approx(report(mesh)["volume"], rel=0.01)


@pytest.mark.parametrize("seed", range(28))
def test_random_scenes(seed: int) -> None:
    """Always a surface of the same kind, mirrored or not, cut or not, however few faces are asked for."""
    rng = default_rng(seed)
    scene = random_scene(rng, shapes=1 + seed % 4, exponents=(0.5, 0.8, 1.0, 1.3, 2.0, 4.0, 12.0, 60.0, 400.0))
    if seed % 3 == 0:
        images = ("x",), ("x", "y"), ("x", "y", "z")
        shapes = tuple(shape.changed(mirror=images[seed // 3 % 3]) for shape in scene.shapes)
        scene = scene.changed(shapes=shapes)
    if scene.bounds is None and not region(scene).bounded:
        scene = scene.changed(bounds=((-2.0, -2.0, -2.0), (2.0, 2.0, 2.0)))
    try:
        mesh = polygonize(scene, 32, shading=False)
    except MeshError:
        scene = scene.changed(level=0.01, bounds=((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0)))
        mesh = polygonize(scene, 32, shading=False)
    terms = Terms.of(scene)
    axes = mirror_axes(terms, region(scene, terms))
    assert seed % 3 or axes
    faces = part(mesh, axes)
    if len(faces) << len(axes) != len(mesh.faces):
        axes, faces = (), mesh.faces  # sheets pulled apart where it touched its image
    held = free(mesh) if scene.bounds is None else np.any([mesh.vertices == bound for bound in scene.bounds], axis=0)
    reached = 0
    for share in (rng.uniform(0.01, 0.9), 0.0):
        target = int(share * len(faces))
        result = whole(*simplified(mesh.vertices, faces, target, held, axes), axes)
        sound(result)
        same_kind(result, mesh)
        assert len(result.faces) >> len(axes) >= target - 1
        reached += len(result.faces)
    assert reached < 2 * len(mesh.faces)


def test_unreachable_targets_end_at_the_least() -> None:
    mesh = sphere(24)
    result = Mesh(*simplified(mesh.vertices, mesh.faces, 0, free(mesh)))
    sound(result)
    assert len(result.faces) == 4
    again = simplified(result.vertices, result.faces, 0, free(result))
    assert np.array_equal(again[0], result.vertices)
    assert np.array_equal(again[1], result.faces)


def test_nothing_to_do_leaves_the_mesh() -> None:
    vertices, faces = torus(12, 8)
    result = simplified(np.concatenate([vertices, [[9.0, 9.0, 9.0]]]), faces, len(faces), np.zeros((97, 3), dtype=bool))
    assert np.array_equal(result[0], vertices)
    assert np.array_equal(result[1], faces)


def test_two_bodies_stay_two() -> None:
    ball = tuple(Strip(normal=n) for n in (X, Y, Z))
    pair = [Shape(hardness=20.0, transform=Transform(translation=(d, 0.0, 0.0)), strips=ball) for d in (-1.5, 1.5)]
    mesh = polygonize(Scene(shapes=tuple(pair)), 48, shading=False)
    result = Mesh(*simplified(mesh.vertices, mesh.faces, 0, free(mesh)))
    sound(result)
    assert bodies(result) == 2
    assert len(result.faces) == 8


@pytest.mark.parametrize("target", [2000, 200, 0])
def test_a_torus_keeps_its_hole(target: int) -> None:
    vertices, faces = torus(60, 40)
    result = Mesh(*simplified(vertices, faces, target, np.zeros(vertices.shape, dtype=bool)))
    sound(result)
    assert report(result)["euler_number"] == 0
    assert len(result.faces) >= 14  # no torus has fewer
    assert len(result.faces) <= max(target, 40)


def test_creases_and_corners_stay() -> None:
    mesh = polygonize(box(400.0), 48, shading=False)
    vertices, faces = simplified(mesh.vertices, mesh.faces, 60, free(mesh))
    sound(Mesh(vertices, faces))
    tips = np.stack(np.meshgrid([-1, 1], [-1, 1], [-1, 1]), axis=-1).reshape(-1, 3)
    found, given = (np.min(np.linalg.norm(tips[:, None] - some, axis=2), axis=1) for some in (vertices, mesh.vertices))
    assert np.max(found) <= np.max(given) + 1e-3
    assert report(Mesh(vertices, faces))["volume"] == pytest.approx(report(mesh)["volume"], rel=5e-3)


def test_flat_sides_take_two_triangles_each() -> None:
    vertices, faces = lattice([(0, 0, 0)], 12)
    corners, few = simplified(vertices, faces, 0, np.zeros(vertices.shape, dtype=bool), most=1e-6)
    assert len(few) == 12
    np.testing.assert_allclose(corners, np.rint(corners), atol=1e-6)
    assert len(np.unique(np.rint(corners), axis=0)) == 8


def test_no_face_turns_over() -> None:
    """Not even when points are placed on the surface, but beside where they belong."""
    vertices, faces = lattice([(0, 0, 0)], 12)
    free_all = np.zeros(vertices.shape, dtype=bool)
    vertices = onto_sphere(vertices - 0.5, free_all)

    def beside(points: Array, held: Bools) -> Array:
        x, y, z = points.T
        return onto_sphere(np.column_stack([x - 0.11 * y, y + 0.11 * x, z]), held)

    for target in (1400, 1000, 600):
        result, fewer = simplified(vertices, faces, target, free_all, place=beside)
        assert len(fewer) == target
        a, b, c = (result[fewer[:, i]] for i in range(3))
        assert np.min(np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c)) > 0


def test_a_box_cut_on_all_sides_keeps_its_corners_to_the_bit() -> None:
    vertices, faces = lattice([(0, 0, 0)], 9)
    corners, few = simplified(vertices * 0.3 + 0.1, faces, 0, (vertices == 0) | (vertices == 1))
    assert len(few) == 12
    assert set(corners.ravel().tolist()) == {0.1, 0.4}
    assert len(np.unique(corners, axis=0)) == 8


def test_triangles_go_where_curvature_is() -> None:
    mesh = polygonize(box(8.0), 64, shading=False)
    vertices, faces = simplified(mesh.vertices, mesh.faces, 3000, free(mesh))
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    across = np.cross(b - a, c - a)
    size = np.linalg.norm(across, axis=1)
    flat = np.max(np.abs(across), axis=1) > 0.999 * size
    assert np.mean(size[flat]) > 2 * np.mean(size[~flat])


def test_no_slivers_on_a_sphere() -> None:
    mesh = sphere(64)
    vertices, faces = simplified(mesh.vertices, mesh.faces, len(mesh.faces) // 5, free(mesh))
    corners = vertices[faces]
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    sides.sort(axis=1)
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    angle = np.degrees(np.arcsin(area / (sides[:, 1] * sides[:, 2])))
    assert np.min(angle) > 5
    assert np.mean(angle) > 40


@pytest.mark.parametrize("share", [0.5, 0.05])
def test_place_brings_vertices_onto_the_surface(share: float) -> None:
    mesh = sphere(48)
    start = onto_sphere(mesh.vertices, free(mesh))
    vertices, faces = simplified(start, mesh.faces, int(share * len(mesh.faces)), free(mesh), place=onto_sphere)
    sound(Mesh(vertices, faces))
    np.testing.assert_allclose(np.linalg.norm(vertices, axis=1), 1, atol=1e-9)


@pytest.mark.parametrize("factor", [np.nan, 0.0, 1e9])
def test_a_point_that_strays_is_not_taken(factor: float) -> None:
    mesh = sphere(12)
    vertices, faces = simplified(mesh.vertices, mesh.faces, 500, free(mesh), place=lambda points, held: points * factor)
    sound(Mesh(vertices, faces))
    assert set(map(tuple, vertices)) <= set(map(tuple, mesh.vertices))


@pytest.mark.parametrize("most", [1e-3, 4e-3, 2e-2])
def test_most_bounds_the_distance(most: float) -> None:
    mesh = sphere(96)
    vertices, faces = simplified(onto_sphere(mesh.vertices, free(mesh)), mesh.faces, 0, free(mesh), place=onto_sphere, most=most)
    sound(Mesh(vertices, faces))
    sagitta = 1 - np.linalg.norm(vertices[faces].mean(axis=1), axis=1)
    assert np.max(sagitta) < most
    assert len(faces) < 40 / most  # equilateral triangles with such sagittas would be 8 pi / (3 sqrt(3) most)
    assert np.max(np.abs(np.linalg.norm(vertices, axis=1) - 1)) < 1e-9 + 1e-9


@pytest.mark.parametrize("found", [1.0, np.nan])
def test_held_vertices_stay(found: float) -> None:
    mesh = sphere(32)
    held = free(mesh)
    chosen = default_rng(3).choice(len(mesh.vertices), 40, replace=False)
    held[chosen] = True
    vertices, faces = simplified(mesh.vertices, mesh.faces, 2000, held, place=lambda points, held: points * found)
    sound(Mesh(vertices, faces))
    assert len(faces) == 2000
    assert set(map(tuple, mesh.vertices[chosen])) <= set(map(tuple, vertices))


def test_what_holds_different_coordinates_is_not_merged() -> None:
    vertices, faces = torus(20, 12)
    rng = default_rng(0)
    vertices = vertices + 0.01 * rng.normal(size=vertices.shape)
    held = rng.integers(0, 3, len(vertices))[:, None] == np.arange(3)
    result = simplified(vertices, faces, 0, held)
    assert np.array_equal(result[0], vertices)
    assert np.array_equal(result[1], faces)


@pytest.mark.parametrize("found", [1.0, np.nan])
def test_caps_stay_in_their_planes(found: float) -> None:
    """Also where no point but those there are already is found on the surface."""
    pipe = Scene(shapes=(Shape(strips=(Strip(normal=X), Strip(normal=Y))),), bounds=((-2, -2, -1), (2, 2, 1.5)))
    mesh = polygonize(pipe, 64, shading=False)
    held = free(mesh)
    held[:, 2] = np.isin(mesh.vertices[:, 2], [-1, 1.5])

    def place(points: Array, held: Bools) -> Array:
        assert np.array_equal(held[:, 2], np.isin(points[:, 2], [-1, 1.5]))
        radius = np.linalg.norm(points[:, :2], axis=1, keepdims=True)
        assert np.min(radius) > 0.8
        return np.column_stack([points[:, :2] / radius, points[:, 2]]) * found

    vertices, faces = simplified(mesh.vertices, mesh.faces, 800, held, place=place)
    sound(Mesh(vertices, faces))
    assert len(faces) == 800
    assert report(Mesh(vertices, faces))["volume"] == pytest.approx(2.5 * np.pi, rel=0.02)
    beside = np.min(np.abs(vertices[:, 2:] - [-1, 1.5]), axis=1)
    assert np.all((beside == 0) | (beside > 1e-6))
    walls = faces[np.ptp(vertices[:, 2][faces], axis=1) > 0]
    np.testing.assert_allclose(np.linalg.norm(vertices[walls][..., :2], axis=-1), 1, atol=3e-4)
    for cap in (-1, 1.5):
        lid = faces[np.all(vertices[:, 2][faces] == cap, axis=1)]
        a, b, c = (vertices[lid[:, i], :2] for i in range(3))
        area = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
        assert np.all(area * cap > 0)
        assert abs(area.sum()) / 2 == pytest.approx(np.pi, rel=0.02)


@pytest.mark.parametrize("axes", [(0,), (2,), (0, 1), (0, 1, 2)])
@pytest.mark.parametrize("name", ["two_holes", "cuboctahedron", "thin_plate", "cylinder"])
def test_parts_join_with_their_images(name: str, axes: tuple[int, ...]) -> None:
    mesh = polygonize(case(name).scene, 40, shading=False)
    faces = part(mesh, axes)
    assert len(faces) << len(axes) == len(mesh.faces)
    for target in (len(faces) // 2, len(faces) // 10, 0):
        vertices, fewer = simplified(mesh.vertices, faces, target, free(mesh), axes)
        result = whole(vertices, fewer, axes)
        sound(result)
        same_kind(result, mesh)
        start, end = fewer.ravel(), np.roll(fewer, -1, axis=1).ravel()
        joined = {*zip(end.tolist(), start.tolist(), strict=True)}
        border = [edge for edge in zip(start.tolist(), end.tolist(), strict=True) if edge not in joined]
        assert len({a for a, _ in border}) == len(border) > 0
        assert all(np.any(np.all(vertices[list(edge)][:, list(axes)] == 0, axis=0)) for edge in border)
        if target:
            assert target - 1 <= len(fewer) <= target
            assert report(result)["volume"] == pytest.approx(report(mesh)["volume"], rel=0.02)


def test_a_border_that_is_no_mirror_plane_stays() -> None:
    mesh = sphere(24)
    faces = part(mesh, (0,))
    vertices, fewer = simplified(mesh.vertices, faces, 60, free(mesh))
    rim = mesh.vertices[:, 0] == 0
    assert set(map(tuple, mesh.vertices[rim])) <= set(map(tuple, vertices))
    sound(whole(vertices, fewer, (0,)))


def test_sheets_that_touch_along_an_edge_stay_so() -> None:
    vertices, faces = lattice([(0, 0, 0), (1, 1, 0)], 6)
    result, fewer = simplified(vertices, faces, 0, np.zeros(vertices.shape, dtype=bool), most=1e-6)
    pairs, count = np.unique(
        np.sort(np.stack([fewer, np.roll(fewer, 1, axis=1)], -1).reshape(-1, 2), axis=1), axis=0, return_counts=True
    )
    assert len(fewer) < len(faces) / 5
    assert set(count.tolist()) == {2, 4}
    assert np.all(result[pairs[count == 4]][..., :2] == 1)
    assert np.count_nonzero(count == 4) == 6
    assert report(Mesh(result, fewer))["volume"] == pytest.approx(2)


def test_a_ridge_that_touches_its_image_stays() -> None:
    vertices, faces = lattice([(0, 0, 0)], 8)
    ridge = np.all(vertices[:, :2] == 0, axis=1)
    x, y, z = vertices.T
    standing = np.column_stack([x + y, y - x, z])
    result, fewer = simplified(standing, faces, 0, np.zeros(vertices.shape, dtype=bool), (0,), most=1e-6)
    assert len(fewer) < len(faces) / 10
    assert set(map(tuple, standing[ridge])) <= set(map(tuple, result))
    assert np.count_nonzero(result[:, 0] == 0) == np.count_nonzero(ridge)


def test_the_same_mesh_gives_the_same_bytes() -> None:
    mesh = polygonize(case("composite_0").scene, 48, shading=False)
    first, second = (simplified(mesh.vertices.copy(), mesh.faces.copy(), 1500, free(mesh)) for _ in range(2))
    assert first[0].tobytes() == second[0].tobytes()
    assert first[1].tobytes() == second[1].tobytes()


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_size_and_place_do_not_matter(scale: float) -> None:
    """A ball of any size, away from the origin by ten thousand times that, becomes the same."""
    mesh = sphere(24)
    near, far = (simplified(some, mesh.faces, 200, free(mesh)) for some in (mesh.vertices, scale * (mesh.vertices + 1e4)))
    sound(Mesh(*far))
    assert len(far[1]) == len(near[1]) == 200
    assert np.max(np.abs(np.linalg.norm(far[0] / scale - 1e4, axis=1) - 1)) < 0.03
