"""new: presets from frames, one command away, or one line that says why not."""

from __future__ import annotations

import json
from math import sqrt
from pathlib import Path

import pytest

from hqmodel.edit import STARTS
from hqmodel.files import load
from hqmodel.mesh import polygonize, report

from .conftest import Command, files


def test_a_solid_is_one_command_away(hqmodel: Command) -> None:
    ended = hqmodel("new", "--frame", "dodecahedron", "--gamma", 400, "-o", "d.json", "--json")
    assert (ended.status, ended.err) == (0, "")
    result = json.loads(ended.out)
    assert result["strips"] == 6
    assert result["slice_range"] is None
    assert result["frame_residual"] < 1e-12
    assert result["files"] == ["d.json"]
    inradius = sqrt(2)
    volume = 10 * sqrt(130 - 58 * sqrt(5)) * inradius**3
    assert report(polygonize(load("d.json"), 48))["volume"] == pytest.approx(volume, rel=0.01)
    assert hqmodel("check", "d.json").status == 0


def test_exponent_slice_terms_and_seed_are_those_asked_for(hqmodel: Command) -> None:
    arguments = ("new", "--frame", "random", "--terms", 9, "--gamma", 3, "--slice", -0.25)
    for name, seed in (("a.json", 5), ("b.json", 5), ("c.json", 6)):
        assert hqmodel(*arguments, "--seed", seed, "-o", name, "-q") == (0, "", "")
    scene = load("a.json")
    assert scene.slice == -0.25
    assert [strip.gamma for strip in scene.shapes[0].strips] == [3.0] * 9
    assert Path("a.json").read_bytes() == Path("b.json").read_bytes() != Path("c.json").read_bytes()


def test_people_are_told_how_far_the_slice_goes(hqmodel: Command) -> None:
    ended = hqmodel("new", "--frame", "truncated-tetrahedron", "--gamma", 2, "-o", "a.json")
    assert ended.out == "a.json: truncated-tetrahedron, 4 strips, gamma 2, t = 0.5, t from -1 to 1\n"


def test_help_lists_every_frame(hqmodel: Command) -> None:
    text = "".join(hqmodel("new", "--help").out.split())
    assert all(name in text for name in STARTS)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--frame", "cub"], "--frame: expected one of simplex3, "),
        (["--frame", "cube", "--gamma", "0"], "--gamma: expected a number from 0.05 to 1000, got 0\n"),
        (["--frame", "cube", "--gamma", "nan"], "--gamma: expected a number from 0.05 to 1000, got nan\n"),
        (["--frame", "cube", "--slice", "inf"], "--slice: slice: expected a finite number, got inf\n"),
        (["--frame", "random", "--terms", "3"], "hqmodel new: Invalid value for '--terms'"),
        (["--frame", "random", "--terms", "1025"], "hqmodel new: Invalid value for '--terms'"),
        (["--frame", "random", "--seed", "-1"], "hqmodel new: Invalid value for '--seed'"),
        ([], "hqmodel new: Missing option '--frame'"),
    ],
)
def test_what_cannot_be_made_is_told(hqmodel: Command, arguments: list[str], message: str) -> None:
    ended = hqmodel("new", *arguments, "-o", "a.json")
    assert (ended.status, ended.out) == (2, "")
    assert ended.err.startswith(message)
    assert ended.err.count("\n") == 1
    assert files() == {"ball.json"}


@pytest.mark.parametrize("path", ["a.txt", "no/a.json"])
def test_where_nothing_can_be_written(hqmodel: Command, path: str) -> None:
    assert hqmodel("new", "--frame", "cube", "-o", path).status == 2
    assert files() == {"ball.json"}
