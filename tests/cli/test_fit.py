"""fit: a preset from a file of points, and faults told in one line."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from hqmodel.files import load
from hqmodel.fit import read
from hqmodel.mesh import polygonize, report

from .conftest import Command, files


def test_points_of_a_ball_become_a_ball(hqmodel: Command) -> None:
    points = np.random.default_rng(3).normal(size=(800, 3))
    points *= 1.5 / np.linalg.norm(points, axis=1, keepdims=True)
    np.savetxt("ball.xyz", points + np.array([1.0, 2.0, 3.0]))
    ended = hqmodel("fit", "ball.xyz", "-o", "fitted.json", "--json")
    assert (ended.status, ended.err) == (0, "")
    assert json.loads(ended.out)
    body = report(polygonize(load("fitted.json"), 64))
    assert body["volume"] == pytest.approx(4 / 3 * np.pi * 1.5**3, rel=0.02)
    assert hqmodel("check", "fitted.json").status == 0


@pytest.mark.parametrize("text", ["", "1 2 3\n4 5\n", "these are words\n", "1 2 3\n4 5 6\n"])
def test_a_file_without_a_cloud_is_told(hqmodel: Command, text: str) -> None:
    Path("cloud.xyz").write_text(text)
    ended = hqmodel("fit", "cloud.xyz", "-o", "fitted.json")
    assert ended.status == 1
    assert ended.err.startswith("cloud.xyz: ")
    assert ended.err.count("\n") == 1
    assert "fitted.json" not in files()


def ply(vertices: int, faces: int, body: bytes) -> bytes:
    """A PLY file in letters."""
    axes = b"".join(b"property float %c\n" % axis for axis in b"xyz")
    elements = b"element vertex %d\n%selement face %d\nproperty list uchar int vertex_indices\n" % (vertices, axes, faces)
    return b"ply\nformat ascii 1.0\n%send_header\n%s" % (elements, body)


CORNERS = b"0 0 0\n1 0 0\n0 1 0\n0 0 1\n"


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("cloud.xyz", b"1 2 3\n4 5\n", "cloud.xyz: line 2: expected 3 numbers, got 2"),
        ("cloud.xyz", b"# x y z\n1 2 3\n4 nan 6\n", "cloud.xyz: line 3: expected finite numbers, got 'nan'"),
        ("cloud.ply", b"not a PLY file at all\n", "cloud.ply: expected a file of the format PLY, got one that can't be read: "),
        (
            "cloud.ply",
            ply(1000, 0, CORNERS),
            "cloud.ply: header: expected 1,000 lines after it, one for each thing it names, got 4",
        ),
        ("cloud.ply", ply(3, 0, CORNERS), "cloud.ply: header: expected 3 lines after it, one for each thing it names, got 4"),
        ("cloud.ply", ply(4, 2, CORNERS + b"3 0 1 2\n"), "cloud.ply: header: expected 6 lines after it, "),
        ("cloud.ply", ply(4, 1, CORNERS + b"3 0 1 4\n"), "cloud.ply: face 0: expected vertices from 0 to 3, got [0, 1, 4]"),
        ("cloud.obj", b"", "cloud.obj: "),
        ("cloud.stl", b"\x00" * 90, "cloud.stl: "),
        ("cloud.json", b"{}", "cloud.json: expected a file name that ends in .ply, .obj, .stl, .xyz, got .json"),
    ],
)
def test_a_wrong_file_is_told_with_the_place(hqmodel: Command, name: str, content: bytes, told: str) -> None:
    Path(name).write_bytes(content)
    ended = hqmodel("fit", name, "-o", "fitted.json")
    assert ended.status == 1
    assert ended.err.startswith(told)
    assert ended.err.count("\n") == 1
    assert "fitted.json" not in files()


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (("--parts", "none"), "--parts"),
        (("--parts", "65"), "--parts"),
        (("--tolerance", "1"), "--tolerance"),
        (("--strips", "2"), "--strips"),
        (("--compare", "picture.gif"), "picture.gif"),
    ],
)
def test_a_command_line_at_fault_is_told_before_the_cloud_is_read(hqmodel: Command, options: tuple[str, str], told: str) -> None:
    ended = hqmodel("fit", "missing.xyz", "-o", "fitted.json", *options)
    assert ended.status == 2
    assert told in ended.err


def test_a_header_may_be_long(tmp_path: Path) -> None:
    path = tmp_path / "cloud.ply"
    path.write_bytes(ply(4, 0, CORNERS).replace(b"end_header", b"comment of a scanner\n" * 300 + b"end_header"))
    assert len(read(path).points) == 4


def test_a_missing_cloud_is_told(hqmodel: Command) -> None:
    ended = hqmodel("fit", "missing.xyz", "-o", "fitted.json")
    assert (ended.status, ended.err) == (1, "missing.xyz: expected a file that can be read, got: No such file or directory\n")


def test_points_and_fit_are_shown_side_by_side(hqmodel: Command) -> None:
    points = np.random.default_rng(3).normal(size=(200, 3))
    np.savetxt("ball.xyz", points / np.linalg.norm(points, axis=1, keepdims=True))
    assert hqmodel("fit", "ball.xyz", "-o", "fitted.json", "--strips", 3, "--compare", "both.png", "-q") == (0, "", "")
    cloud, body = np.split(np.asarray(Image.open("both.png"), dtype=float), 2, axis=1)
    high, wide = body.shape[0] // 4, body.shape[1] // 4
    assert np.count_nonzero(cloud[high:-high, wide:-wide].max(axis=-1) < 200) > 200
    warmth = body[..., 0] - body[..., 2]  # clay is, the floor isn't
    assert warmth[high * 2, wide * 2] > 30
    assert warmth[:20].max() < 20
