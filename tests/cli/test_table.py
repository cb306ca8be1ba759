"""sample and raycast: tables in with exact complaints, tables out with every digit."""

from __future__ import annotations

import csv
import json
from math import sqrt
from pathlib import Path

import numpy as np
import pytest

from hqmodel import gpu
from hqmodel.cli.table import BLOCK, rows, text_of
from hqmodel.field import Terms, curvature, gradient, value
from hqmodel.files import load

from .conftest import Command, files

SAMPLED = "x,y,z,value,gradient_x,gradient_y,gradient_z,gaussian_curvature,mean_curvature"


def read(path: str) -> list[dict[str, str]]:
    with Path(path).open(newline="") as stream:
        return list(csv.DictReader(stream))


def test_sampled_values_are_the_fields_own_to_the_last_bit(hqmodel: Command) -> None:
    points = np.random.default_rng(3).normal(size=(500, 3))
    Path("p.csv").write_bytes(b"x,y,z\n" + text_of(points))
    assert hqmodel("sample", "ball.json", "p.csv", "-o", "o.csv", "-q") == (0, "", "")
    assert Path("o.csv").read_text().splitlines()[0] == SAMPLED
    terms = Terms.of(load("ball.json"))
    bent = curvature(terms, points)
    expected = np.column_stack([points, value(terms, points), gradient(terms, points), bent.gaussian, bent.mean])
    assert np.array_equal(np.loadtxt("o.csv", delimiter=",", skiprows=1), expected)


def test_a_sphere_of_radius_one_has_curvature_one(hqmodel: Command) -> None:
    Path("p.csv").write_text("x,y,z\n0,0.6,0.8\n")
    ended = hqmodel("sample", "ball.json", "p.csv", "-o", "o.csv", "--json")
    assert {key: json.loads(ended.out)[key] for key in ("points", "files")} == {"points": 1, "files": ["o.csv"]}
    (row,) = read("o.csv")
    assert float(row["value"]) == pytest.approx(0, abs=1e-15)
    assert [float(row[f"gradient_{axis}"]) for axis in "xyz"] == pytest.approx([0, -1.2, -1.6])
    assert float(row["gaussian_curvature"]) == pytest.approx(1)
    assert float(row["mean_curvature"]) == pytest.approx(1)


def test_options_apply_to_what_is_sampled(hqmodel: Command) -> None:
    Path("p.csv").write_text("x,y,z\n0,0,0\n")
    hqmodel("sample", "ball.json", "p.csv", "-o", "o.csv", "--set", "level=0.25")
    assert float(read("o.csv")[0]["value"]) == pytest.approx(np.e - 0.25)


def test_distances_are_in_world_units_whatever_the_directions_length(hqmodel: Command) -> None:
    lengths = [1.0, 2.0, 1e-200, 1e200]
    rays = [f"0.6,0,5,0,0,{-length!r}" for length in lengths] + ["0,3,5,0,0,-1", "0,0,0.5,0,0,1"]
    Path("r.csv").write_text("\n".join(["ox,oy,oz,dx,dy,dz", *rays]) + "\n")
    ended = hqmodel("raycast", "ball.json", "r.csv", "-o", "o.csv", "--cpu", "--json")
    result = json.loads(ended.out)
    assert (result["rays"], result["hits"], result["misses"], result["device"]) == (6, 5, 1, "cpu")
    found = read("o.csv")
    assert list(found[0]) == ["ox", "oy", "oz", "dx", "dy", "dz", "distance"]
    assert [float(row["distance"]) for row in found[:4]] == pytest.approx([4.2] * 4, abs=1e-9)
    assert found[4]["distance"] == ""
    assert float(found[5]["distance"]) == 0.0
    assert float(found[3]["dz"]) == -1e200


def test_the_gpu_agrees(hqmodel: Command) -> None:
    Path("r.csv").write_text("ox,oy,oz,dx,dy,dz\n0.6,0,5,0,0,-3\n0,3,5,0,0,-1\n3,3,3,-1,-1,-1\n")
    ended = hqmodel("raycast", "ball.json", "r.csv", "-o", "o.csv", "--json")
    assert (json.loads(ended.out)["hits"], json.loads(ended.out)["device"]) == (2, "gpu")
    distances = [row["distance"] for row in read("o.csv")]
    assert distances[1] == ""
    assert [float(distances[0]), float(distances[2])] == pytest.approx([4.2, 3 * sqrt(3) - 1], abs=1e-4)


@pytest.mark.parametrize(
    ("needed", "command"),
    [
        ("offscreen", ["raycast", "ball.json", "r.csv", "-o", "o.csv"]),
        ("raycast", ["raycast", "ball.json", "r.csv", "-o", "o.csv"]),
        ("render", ["render", "ball.json", "-o", "o.png"]),
        ("render", ["figures", "-o", "out", "--only", "12", "--size", "40"]),
    ],
)
def test_a_machine_without_opengl_is_told_what_to_install(
    hqmodel: Command, monkeypatch: pytest.MonkeyPatch, needed: str, command: list[str]
) -> None:
    """Whether it is found not to be there at first, or fails when it is drawn with."""

    def lacking(*_: object, **__: object) -> None:
        raise gpu.GpuError("OpenGL 3.3 is needed: install libegl1")

    monkeypatch.setattr(gpu, needed, lacking)
    Path("r.csv").write_text("ox,oy,oz,dx,dy,dz\n0.6,0,5,0,0,-3\n")
    ended = hqmodel(*command)
    assert (ended.status, ended.out) == (3, "")
    assert ended.err.startswith("OpenGL 3.3 is needed: install libegl1")
    assert ended.err.count("\n") == 1
    assert files() == {"ball.json", "r.csv"}


GOOD = [
    "x,y,z\n0,0,0\n1,2,3",
    "x,y,z\r\n0,0,0\r\n1,2,3\r\n",
    "\ufeffx,y,z\n0,0,0\n1,2,3\n",
    " X , Y , Z \n 0 , 0 , 0 \n1,2,3\n",
    "z,name,y,x\n0,a,0,0\n3,b,2,1\n",
    '"x","y","z"\n"0","0","0"\n1,"2",3\n',
    'x,y,z,note\n0,0,0,"a, b"\n1,2,3,\n',
    "x,y,z\n0,0,0\n\n  \n1,2,3\n\n",
    "x,y,z\n+0.,.0,0e5\n1E0,2e+0,30e-1\n",
]


@pytest.mark.parametrize("text", GOOD)
def test_tables_come_in_many_guises(tmp_path: Path, text: str) -> None:
    (tmp_path / "p.csv").write_bytes(text.encode())
    (block,) = rows(tmp_path / "p.csv", ("x", "y", "z"))
    assert block.values.tolist() == [[0, 0, 0], [1, 2, 3]]


def test_every_double_survives(tmp_path: Path) -> None:
    bits = np.random.default_rng(11).integers(0, 1 << 63, 3000, dtype=np.uint64)
    numbers = bits.view(np.float64)
    values = np.where(np.isfinite(numbers), numbers, -0.0).reshape(-1, 3)
    (tmp_path / "p.csv").write_bytes(b"x,y,z\n" + text_of(values))
    (block,) = rows(tmp_path / "p.csv", ("x", "y", "z"))
    assert block.values.tobytes() == values.tobytes()


def test_a_table_of_no_rows_gives_a_table_of_no_rows(hqmodel: Command) -> None:
    Path("p.csv").write_text("x,y,z\n")
    assert hqmodel("sample", "ball.json", "p.csv", "-o", "o.csv").status == 0
    assert Path("o.csv").read_text() == SAMPLED + "\n"


BAD = [
    ("", "line 1: expected the columns x,y,z, got an empty line"),
    ("0,0,0\n1,2,3\n", "line 1: expected the columns x,y,z, got '0,0,0'"),
    ("x;y;z\n0;0;0\n", "line 1: expected the columns x,y,z, got 'x;y;z'"),
    ("x,y\n0,0\n", "line 1: expected the columns x,y,z, got 'x,y'"),
    ("x,y,z,x\n0,0,0,0\n", "line 1: expected the columns x,y,z, got 'x,y,z,x'"),
    ("x,y,z\n0,0,0\n1,,3\n", "line 3, column y: expected a finite number, got an empty cell"),
    ("x,y,z\n0,0,0\n\n1, ,3\n", "line 4, column y: expected a finite number, got an empty cell"),
    ("x,y,z\n0,0,nan\n", "line 2, column z: expected a finite number, got 'nan'"),
    ("x,y,z\n0,0,-inf\n", "line 2, column z: expected a finite number, got '-inf'"),
    ("x,y,z\n0,1e999,0\n", "line 2, column y: expected a finite number, got '1e999'"),
    ("x,y,z\n0,0,0\n0,one,0\n", "line 3, column y: expected a finite number, got 'one'"),
    ("x,y,z\n0,0x10,0\n", "line 2, column y: expected a finite number, got '0x10'"),
    ("x,y,z\n0,1_0,0\n", "line 2, column y: expected a finite number, got '1_0'"),
    ("x,y,z\n0,0,0\n0,0\n", "line 3: expected 3 cells, got 2"),
    ("x,y,z\n0,0,0,0\n", "line 2: expected 3 cells, got 4"),
    ("x,y,z\n" + "0,0,0\n" * (BLOCK + 10) + "0,0,a\n", f"line {BLOCK + 12}, column z: expected a finite number, got 'a'"),
]


@pytest.mark.parametrize(("text", "message"), BAD, ids=lambda value: value[:24])
def test_what_is_no_table_of_numbers_is_told_by_line(hqmodel: Command, text: str, message: str) -> None:
    Path("p.csv").write_text(text)
    assert hqmodel("sample", "ball.json", "p.csv", "-o", "o.csv") == (1, "", f"p.csv: {message}\n")
    assert files() == {"ball.json", "p.csv"}


def test_a_direction_of_no_length_is_told_by_line(hqmodel: Command) -> None:
    Path("r.csv").write_text("ox,oy,oz,dx,dy,dz\n0,0,5,0,0,-1\n\n0,0,5,0,0,0\n")
    ended = hqmodel("raycast", "ball.json", "r.csv", "-o", "o.csv", "--cpu")
    assert ended == (1, "", "r.csv: line 4: expected a direction that is not zero, got 0,0,0\n")
    assert files() == {"ball.json", "r.csv"}


def test_a_table_that_is_not_there_is_told(hqmodel: Command) -> None:
    ended = hqmodel("sample", "ball.json", "p.csv", "-o", "o.csv")
    assert ended == (1, "", "p.csv: expected a file that can be read, got: No such file or directory\n")
    assert hqmodel("sample", "ball.json", ".", "-o", "o.csv").err == ".: expected a file that can be read, got: Is a directory\n"


def test_the_preset_is_not_written_over(hqmodel: Command) -> None:
    Path("p.csv").write_text("x,y,z\n0,0,0\n")
    before = Path("ball.json").read_text()
    ended = hqmodel("sample", "ball.json", "p.csv", "-o", "./ball.json")
    assert ended == (2, "", "ball.json: expected another file than the preset, got the same\n")
    assert Path("ball.json").read_text() == before


def test_a_table_may_replace_itself(hqmodel: Command) -> None:
    Path("p.csv").write_text("x,y,z\n0,0,0\n")
    assert hqmodel("sample", "ball.json", "p.csv", "-o", "p.csv").status == 0
    assert Path("p.csv").read_text().startswith(SAMPLED)
