"""Files read back by other programs: trimesh and assimp for all, meshio where it can, the 3MF by its own words."""

from __future__ import annotations

import io
import json
import struct
import xml.etree.ElementTree as ET
import zipfile
from functools import cache
from pathlib import Path
from typing import Any

import assimp_py
import meshio
import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

from hqmodel.mesh import FORMATS, Mesh, MeshError, fitted, polygonize, report, sized, write
from hqmodel.model import Scene, Shape, Strip, Transform

from ..cases import case


@cache
def body() -> Mesh:
    """Longer in y than in x and z, two colours, blended."""
    strips = tuple(Strip(normal=n) for n in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    red = Shape(color=(1.0, 0.2, 0.1), strips=strips, hardness=3.0, transform=Transform(scale=(1.0, 2.0, 0.5)))
    blue = Shape(color=(0.1, 0.2, 1.0), strips=strips, hardness=3.0, transform=Transform(translation=(0.0, 1.5, 0.4)))
    return polygonize(Scene(shapes=(red, blue)), 40)


def written(mesh: Mesh, suffix: str, name: str = "hqmodel") -> bytes:
    stream = io.BytesIO()
    write(mesh, stream, suffix, name)
    return stream.getvalue()


def linear(srgb: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def read(data: bytes, suffix: str) -> Any:
    return trimesh.load(io.BytesIO(data), file_type=suffix[1:], force="mesh")


@pytest.mark.parametrize("suffix", FORMATS)
def test_trimesh_reads_the_same_body(suffix: str) -> None:
    loaded = read(written(fitted(body(), suffix), suffix), suffix)
    assert loaded.is_watertight
    assert loaded.is_winding_consistent
    assert (len(loaded.vertices), len(loaded.faces)) == (len(body().vertices), len(body().faces))
    assert loaded.volume == pytest.approx(report(body())["volume"], rel=1e-5)
    assert loaded.unique_faces().all()
    assert loaded.nondegenerate_faces().all()


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".stl"])
def test_meshio_reads_the_same_triangles(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"body{suffix}"
    path.write_bytes(written(fitted(body(), suffix, up="z"), suffix))
    loaded = meshio.read(path)
    triangles = loaded.points[:, :3][loaded.cells_dict["triangle"]]
    np.testing.assert_allclose(triangles, body().vertices[body().faces], atol=1e-6)


@pytest.mark.parametrize("suffix", FORMATS)
def test_assimp_reads_the_same_triangles_and_colours(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"body{suffix}"
    path.write_bytes(written(fitted(body(), suffix, up="z"), suffix, "ear"))
    (loaded,) = assimp_py.import_file(str(path), 0).meshes
    corners = np.array(loaded.indices).ravel()
    points = np.array(loaded.vertices).reshape(-1, 3)[corners]
    np.testing.assert_allclose(points.reshape(-1, 3, 3), body().vertices[body().faces], atol=1e-6)
    if suffix == ".stl":
        return
    srgb = np.asarray(body().colors)[body().faces.ravel()] / 255
    colors = np.array(loaded.colors[0]).reshape(len(loaded.vertices) // 3, -1)[corners, :3]
    np.testing.assert_allclose(colors, linear(srgb) if suffix == ".glb" else srgb, atol=0.003)


@pytest.mark.parametrize("suffix", FORMATS)
def test_up_axis_by_custom_and_by_wish(suffix: str) -> None:
    longest = {".obj": 2, ".glb": 2}.get(suffix, 1)  # y of the modeller goes to -z where y is up
    assert int(np.argmax(np.ptp(fitted(body(), suffix).vertices, axis=0))) == longest
    assert int(np.argmax(np.ptp(fitted(body(), suffix, up="y").vertices, axis=0))) == 2
    assert int(np.argmax(np.ptp(fitted(body(), suffix, up="z").vertices, axis=0))) == 1
    assert report(fitted(body(), suffix, up="y"))["volume"] == pytest.approx(report(body())["volume"])


@pytest.mark.parametrize(
    ("suffix", "unit", "expected"),
    [
        (".obj", "cm", 5.0),
        (".ply", "in", 5.0),
        (".stl", "cm", 50.0),
        (".stl", "mm", 5.0),
        (".glb", "cm", 0.05),
        (".3mf", "in", 127.0),
    ],
)
def test_five_of_a_unit(suffix: str, unit: str, expected: float) -> None:
    mesh = fitted(body(), suffix, unit=unit, size=5.0)  # type: ignore[arg-type]
    assert np.max(np.ptp(mesh.vertices, axis=0)) == pytest.approx(expected)
    assert mesh.surface_error == pytest.approx((body().surface_error or 0) * expected / np.max(np.ptp(body().vertices, axis=0)))


def test_sizes_that_are_none() -> None:
    for size in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(MeshError, match="size: expected a number from 1e-15"):
            sized(body(), size)


def test_obj_has_normals_and_colours() -> None:
    lines = written(body(), ".obj", "two words").decode().splitlines()
    assert "o two_words" in lines
    vertices = np.array([line.split()[1:] for line in lines if line.startswith("v ")], dtype=float)
    np.testing.assert_allclose(vertices[:, :3], body().vertices, atol=1e-7)
    np.testing.assert_allclose(vertices[:, 3:] * 255, np.asarray(body().colors), atol=0.06)
    assert sum(line.startswith("vn ") for line in lines) == len(vertices)
    bare = Mesh(body().vertices, body().faces)
    assert not any("/" in line or line.startswith("vn") for line in written(bare, ".obj").decode().splitlines())


def test_ply_has_srgb_bytes_and_normals() -> None:
    loaded: Any = trimesh.load(io.BytesIO(written(body(), ".ply")), file_type="ply", process=False)
    assert np.array_equal(loaded.visual.vertex_colors[:, :3], np.asarray(body().colors))
    np.testing.assert_allclose(loaded.vertex_normals, np.asarray(body().normals), atol=1e-6)


def test_stl_facets_have_their_normals() -> None:
    loaded: Any = trimesh.load(io.BytesIO(written(body(), ".stl")), file_type="stl", process=False)
    corners = np.asarray(body().vertices)[body().faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    np.testing.assert_allclose(loaded.face_normals, across / np.linalg.norm(across, axis=1)[:, None], atol=1e-4)


@pytest.mark.parametrize("suffix", FORMATS)
def test_files_are_written_in_small_blocks(suffix: str) -> None:
    """So that writing a large one can be stopped at any of them."""
    copies = 20
    faces = np.concatenate([body().faces + np.int32(i * len(body().vertices)) for i in range(copies)])
    tiled: dict[str, Any] = {name: np.tile(getattr(body(), name), (copies, 1)) for name in ("vertices", "normals", "colors")}
    mesh = Mesh(faces=faces, **tiled)
    sizes: list[int] = []

    class Stream(io.BytesIO):
        def write(self, data: Any) -> int:
            sizes.append(len(data))
            return super().write(data)

    write(mesh, Stream(), suffix)
    assert sum(sizes) > 1e6
    assert max(sizes) < 4e6


def test_glb_colours_are_linear() -> None:
    data = written(body(), ".glb", "ear")
    length = struct.unpack("<I", data[12:16])[0]
    tree = json.loads(data[20 : 20 + length])
    assert tree["meshes"][0]["name"] == "ear"
    assert {"POSITION", "NORMAL", "COLOR_0"} <= set(tree["meshes"][0]["primitives"][0]["attributes"])
    loaded = read(data, ".glb")
    srgb = np.asarray(body().colors) / 255
    np.testing.assert_allclose(loaded.visual.vertex_colors[:, :3] / 255, linear(srgb), atol=0.003)


def test_3mf_names_its_unit_and_every_colour() -> None:
    with zipfile.ZipFile(io.BytesIO(written(body(), ".3mf", 'a "b" <c>'))) as package:
        assert package.testzip() is None
        root = ET.fromstring(package.read("3D/3dmodel.model"))
    assert root.get("unit") == "millimeter"
    core = {"c": "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"}
    material = {"m": "http://schemas.microsoft.com/3dmanufacturing/material/2015/02"}
    assert root.find(".//c:object", core) is not None
    assert root.find(".//c:object", core).get("name") == 'a "b" <c>'  # type: ignore[union-attr]
    palette = [entry.get("color") for entry in root.findall(".//m:color", material)]
    assert len(palette) == len(np.unique(np.asarray(body().colors), axis=0))
    triangle = root.findall(".//c:triangle", core)[17]
    entry = int(str(triangle.get("p2")))
    assert palette[entry] == "#" + np.asarray(body().colors)[body().faces[17, 1]].tobytes().hex().upper()


@pytest.mark.parametrize("suffix", FORMATS)
def test_the_same_mesh_gives_the_same_bytes(suffix: str) -> None:
    assert written(body(), suffix) == written(body(), suffix)


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_text_keeps_small_and_large_bodies(scale: float) -> None:
    mesh = polygonize(case("octahedron").scene, 20)
    loaded = read(written(Mesh(mesh.vertices * scale, mesh.faces), ".obj"), ".obj")
    assert loaded.is_watertight
    assert loaded.volume == pytest.approx(4 / 3 * scale**3, rel=1e-3)


def test_unknown_endings() -> None:
    with pytest.raises(MeshError, match=r"expected a file name ending in one of \.obj, \.ply, \.stl, \.glb, \.3mf, got '\.fbx'"):
        write(body(), io.BytesIO(), ".fbx")


def placed(scale: float, away: float) -> Mesh:
    """A ball of that radius, so far from the origin."""
    strips = tuple(Strip(normal=n) for n in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    return polygonize(
        Scene(shapes=(Shape(strips=strips, transform=Transform(scale=(scale,) * 3, translation=(away, 0, 0))),)), 32
    )


@pytest.mark.parametrize("suffix", [".obj", ".3mf"])
def test_text_keeps_a_small_body_far_away_whole(suffix: str) -> None:
    mesh = placed(1.0, 1e5)
    loaded = read(written(fitted(mesh, suffix, up="z"), suffix), suffix)
    assert loaded.is_watertight
    assert len(np.unique(np.asarray(loaded.vertices), axis=0)) == len(mesh.vertices)


@pytest.mark.parametrize("suffix", [".ply", ".stl", ".glb"])
@pytest.mark.parametrize(("scale", "away"), [(1.0, 1e5), (1.0, 1e4), (1e-3, 3.0)])
def test_what_single_precision_cannot_hold_is_refused(suffix: str, scale: float, away: float) -> None:
    with pytest.raises(MeshError, match="expected a body nearer to the origin"):
        written(fitted(placed(scale, away), suffix), suffix)


@pytest.mark.parametrize("suffix", FORMATS)
@pytest.mark.parametrize("scale", [1e-30, 1e30])
def test_sizes_beyond_all_use_are_refused(suffix: str, scale: float) -> None:
    mesh = placed(scale, 0.0)
    report(mesh)
    with pytest.raises(MeshError, match="size: expected a longest side from"):
        written(fitted(mesh, suffix), suffix)
    assert read(written(sized(mesh, 100.0), suffix), suffix).volume == pytest.approx(4.18879 * 50**3, rel=0.02)
