"""export: meshes in every format, sized as asked, or nothing at all."""

from __future__ import annotations

import json
from errno import ENOSPC
from math import pi
from pathlib import Path
from typing import BinaryIO

import numpy as np
import pytest
import trimesh

from hqmodel import mesh
from hqmodel.mesh import FORMATS

from .conftest import BALL, Command, files

REQUIRED = {
    "vertices", "faces", "watertight", "volume", "area", "bounds", "euler_number", "seconds", "files", "surface_error",
}  # fmt: skip


def read(path: str) -> trimesh.Trimesh:
    body = trimesh.load(path, force="mesh")
    assert isinstance(body, trimesh.Trimesh)
    return body


def test_one_mesh_is_written_to_every_file(hqmodel: Command) -> None:
    names = [f"a{suffix}" for suffix in FORMATS]
    ended = hqmodel("export", "ball.json", *[part for name in names for part in ("-o", name)], "--resolution", 24, "--json")
    assert (ended.status, ended.err) == (0, "")
    result = json.loads(ended.out)
    assert set(result) >= REQUIRED
    assert result["files"] == names
    assert result["watertight"] is True
    assert result["euler_number"] == 2
    assert result["volume"] == pytest.approx(4 / 3 * pi, rel=0.01)
    for name in (name for name in names if not name.endswith(".3mf")):
        body = read(name)
        assert body.is_watertight
        assert len(body.faces) == result["faces"]
        assert body.volume == pytest.approx(result["volume"], rel=1e-4)


def test_a_mesh_is_reduced(hqmodel: Command) -> None:
    ended = hqmodel("export", "ball.json", "-o", "a.stl", "--resolution", 32, "--target-faces", 500, "--json")
    result = json.loads(ended.out)
    assert 480 <= result["faces"] <= 500
    assert result["watertight"] is True
    body = read("a.stl")
    assert body.is_watertight
    assert len(body.faces) == result["faces"]
    ended = hqmodel("export", "ball.json", "-o", "b.stl", "--target-faces", 3)
    assert (ended.status, ended.out) == (2, "")
    assert "--target-faces" in ended.err
    assert not Path("b.stl").exists()


def test_a_radial_grid_of_quads(hqmodel: Command) -> None:
    ended = hqmodel("export", "ball.json", "-o", "a.obj", "-o", "a.glb", "--method", "radial", "--resolution", 64, "--json")
    assert (ended.status, ended.err) == (0, "")
    result = json.loads(ended.out)
    assert set(result) >= REQUIRED
    assert (result["quads"], result["faces"], result["watertight"]) == (6 * 16**2, 12 * 16**2, True)
    faces = [line for line in Path("a.obj").read_text().splitlines() if line.startswith("f ")]
    assert {len(face.split()) for face in faces} == {5}
    assert len(faces) == result["quads"]
    assert len(read("a.glb").faces) == result["faces"]


def test_what_has_no_radial_grid_is_told(hqmodel: Command) -> None:
    ended = hqmodel("export", "linked-rings", "-o", "a.obj", "--method", "radial")
    assert (ended.status, ended.out) == (1, "")
    assert ended.err.startswith("linked-rings: expected a body all seen from one point inside, got one turned away from (")
    assert ended.err.count("\n") == 1
    ended = hqmodel("export", "ball.json", "-o", "a.obj", "--method", "radial", "--target-faces", 100)
    assert ended == (2, "", "--target-faces: expected --method cubes with it, got radial\n")
    assert files() == {"ball.json"}


def test_the_same_options_give_the_same_bytes(hqmodel: Command) -> None:
    for name in ("a.obj", "b.obj"):
        assert hqmodel("export", "ball.json", "-o", name, "--resolution", 16).status == 0
    assert Path("a.obj").read_bytes() == Path("b.obj").read_bytes()


def test_people_are_told_what_came_of_it(hqmodel: Command) -> None:
    ended = hqmodel("export", "ball.json", "-o", "a.stl", "--resolution", 16)
    assert ended.out.startswith("a.stl: ")
    assert "watertight" in ended.out
    assert hqmodel("export", "ball.json", "-o", "a.stl", "--resolution", 16, "-q").out == ""


def test_size_and_unit_are_those_asked_for(hqmodel: Command) -> None:
    options = ["--size", 3, "--unit", "cm", "--resolution", 16, "--json"]
    result = json.loads(hqmodel("export", "ball.json", "-o", "a.stl", "-o", "a.glb", "-o", "a.ply", *options).out)
    assert np.ptp(result["bounds"], axis=0).max() == pytest.approx(3)
    for name, longest in [("a.stl", 30), ("a.glb", 0.03), ("a.ply", 3)]:
        assert read(name).extents.max() == pytest.approx(longest, rel=1e-6)


def test_the_up_axis_is_the_formats_or_the_one_asked_for(hqmodel: Command) -> None:
    tall = ["--set", "shapes[0].transform.scale=[1, 1, 3]", "--resolution", 16]
    hqmodel("export", "ball.json", "-o", "a.obj", "-o", "a.stl", *tall)
    hqmodel("export", "ball.json", "-o", "b.obj", "-o", "b.stl", "--up", "z", *tall)
    hqmodel("export", "ball.json", "-o", "c.stl", "--up", "y", *tall)
    longest = {name: int(np.argmax(read(name).extents)) for name in ("a.obj", "a.stl", "b.obj", "b.stl", "c.stl")}
    assert longest == {"a.obj": 1, "a.stl": 2, "b.obj": 2, "b.stl": 2, "c.stl": 1}


def test_colours_and_normals_can_be_left_out(hqmodel: Command) -> None:
    hqmodel("export", "ball.json", "-o", "a.obj", "--resolution", 16)
    hqmodel("export", "ball.json", "-o", "b.obj", "--resolution", 16, "--no-colors", "--no-normals")
    with_all, without = Path("a.obj").read_text(), Path("b.obj").read_text()
    assert "\nvn " in with_all
    assert "\nvn " not in without
    first = {text: next(line for line in text.splitlines() if line.startswith("v ")) for text in (with_all, without)}
    assert [len(line.split()) for line in first.values()] == [7, 4]


@pytest.mark.parametrize(
    ("arguments", "status", "message"),
    [
        (["-o", "a.xyz"], 2, "a.xyz: expected a file name that ends in .obj or .ply or .stl or .glb or .3mf, got .xyz"),
        (["-o", "a"], 2, "a: expected a file name that ends in .obj or .ply or .stl or .glb or .3mf, got no ending"),
        (["-o", "no/a.obj"], 2, "no/a.obj: expected a file in a folder that exists, got no"),
        (["-o", "a.obj", "-o", "./a.obj"], 2, "-o: expected each file once, got a.obj, a.obj"),
        (["-o", "a.obj", "--size", "0"], 2, "--size: expected a number from 1e-15 to 1e+15, got 0"),
        (["-o", "a.obj", "--size", "nan"], 2, "--size: expected a number from 1e-15 to 1e+15, got nan"),
        (["-o", "a.obj", "--tolerance", "0"], 2, "--tolerance: expected a length above 0 such as 0.1 or 0.1mm, got '0'"),
        (["-o", "a.obj", "--tolerance", "1 ft"], 2, "--tolerance: expected a length above 0 such as 0.1 or 0.1mm, got '1 ft'"),
        (
            ["-o", "a.obj", "--tolerance", "0.1mm"],
            2,
            "--tolerance: expected --unit beside it, as lengths in the file have none, got '0.1mm'",
        ),
        (
            ["-o", "a.obj", "--tolerance", "1", "--target-faces", "99"],
            2,
            "--tolerance: expected no --target-faces beside it, got both",
        ),
        (
            ["-o", "a.obj", "--tolerance", "1", "--method", "radial"],
            2,
            "--tolerance: expected --method cubes with it, got radial",
        ),
        (["-o", "dir.obj"], 2, "dir.obj: expected a file that can be written, got: Is a directory"),
    ],
)
def test_what_cannot_be_written_is_told(hqmodel: Command, arguments: list[str], status: int, message: str) -> None:
    Path("dir.obj").mkdir()
    assert hqmodel("export", "ball.json", "--resolution", 8, *arguments) == (status, "", message + "\n")
    assert files() == {"ball.json", "dir.obj"}


@pytest.mark.parametrize("option", [("--resolution", "3"), ("--resolution", "4096"), ("--resolution", "x"), ("--unit", "ft")])
def test_options_out_of_range_are_told(hqmodel: Command, option: tuple[str, str]) -> None:
    ended = hqmodel("export", "ball.json", "-o", "a.obj", *option)
    assert (ended.status, ended.out) == (2, "")
    assert ended.err.startswith(f"hqmodel export: Invalid value for '{option[0]}'")
    assert ended.err.count("\n") == 1


@pytest.mark.parametrize("tolerance", ["0.3", "0.3mm", "0.03 cm"])
def test_a_tolerance_is_in_the_files_unit_unless_it_names_another(hqmodel: Command, tolerance: str) -> None:
    options = ["--unit", "mm", "--size", "50", "--tolerance", tolerance, "--json"]
    told = json.loads(hqmodel("export", "ball.json", "-o", "a.stl", *options).out)
    assert told["tolerance"] == pytest.approx(0.3)
    assert told["faces"] < 1500
    away = np.abs(np.linalg.norm(read("a.stl").triangles_center, axis=1) - 25.0)
    assert 0.1 < away.max() <= told["surface_error"] <= 0.3


def test_a_tolerance_that_is_not_met_is_told(hqmodel: Command) -> None:
    """Half a cell is too much for tips as sharp as these."""
    star = ["--set", "gamma=0.5", "--resolution", 24, "--tolerance", 0.0005]
    ended = hqmodel("export", "ball.json", "-o", "a.stl", *star, "--json")
    assert ended.status == 0
    told = json.loads(ended.out)
    assert told["surface_error"] > 0.0005
    expected = f"--tolerance: expected no point further off than 0.0005, got {told['surface_error']:.2g} at a resolution of 24; "
    assert ended.err.startswith(f"ball.json: {expected}--resolution ")
    assert ended.err.count("\n") == 1
    assert hqmodel("export", "ball.json", "-o", "a.stl", *star, "-q") == (0, "", "")


def test_a_part_that_the_grid_misses_is_named(hqmodel: Command) -> None:
    sheet = {"normal": [0.3, 0.5, 1], "half_width": 0.01, "gamma": 8}
    strips = [sheet, {"normal": [1, 0, -0.3], "half_width": 0.02}, {"normal": [0, 1, -0.5]}]
    Path("fin.json").write_text(json.dumps({**BALL, "shapes": [*BALL["shapes"], {"name": "fin", "strips": strips}]}))
    ended = hqmodel("export", "fin.json", "-o", "a.stl", "--resolution", 24, "--json", "--set", "hardness=20")
    assert json.loads(ended.out)["thin_parts"] == []  # within the ball
    ended = hqmodel("export", "fin.json", "-o", "a.stl", "--resolution", 24, "--json", "--set", "shapes[0].visible=false")
    assert json.loads(ended.out)["thin_parts"] == ["shapes[1]"]
    expected = "fin.json: shapes[1] (fin): expected a part no thinner than the cells, got one that is not seen whole at 24; "
    assert ended.err.startswith(f"{expected}--resolution ")


def test_all_files_or_none(hqmodel: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    Path("a.obj").write_text("before")

    write = mesh.write

    def full_for_stl(body: mesh.Mesh, stream: BinaryIO, suffix: str, name: str) -> None:
        if suffix == ".stl":
            raise OSError(ENOSPC, "No space left on device")
        write(body, stream, suffix, name)

    monkeypatch.setattr(mesh, "write", full_for_stl)
    ended = hqmodel("export", "ball.json", "-o", "a.obj", "-o", "a.stl", "--resolution", 8)
    assert ended == (3, "", "a.obj, a.stl: expected a file that can be written, got: No space left on device\n")
    assert Path("a.obj").read_text() == "before"
    assert files() == {"ball.json", "a.obj"}
