"""section: outlines written, planes understood, faults told."""

from __future__ import annotations

import json
from math import pi

import pytest

from .conftest import Command, files


def test_the_outline_is_written_and_told(hqmodel: Command) -> None:
    ended = hqmodel("section", "ball.json", "--plane", "z=0.6", "-o", "a.svg", "-o", "a.dxf", "--json")
    assert (ended.status, ended.err) == (0, "")
    result = json.loads(ended.out)
    assert result["area"] == pytest.approx(0.64 * pi, rel=1e-4)
    assert result["length"] == pytest.approx(1.6 * pi, rel=1e-4)
    assert result["files"] == ["a.svg", "a.dxf"]
    assert {"a.svg", "a.dxf"} < files()


@pytest.mark.parametrize("plane", ["x=0.6", "y = -0.6", "0,0,-2=1.2", "1e0,0,0=.6"])
def test_planes(hqmodel: Command, plane: str) -> None:
    result = json.loads(hqmodel("section", "ball.json", "--plane", plane, "-o", "a.svg", "--json").out)
    assert result["area"] == pytest.approx(0.64 * pi, rel=1e-4)


def test_the_size_is_that_of_the_longer_side(hqmodel: Command) -> None:
    result = json.loads(hqmodel("section", "ball.json", "-o", "a.svg", "--unit", "mm", "--size", "50", "--json").out)
    assert result["area"] == pytest.approx(625 * pi, rel=1e-4)
    assert result["bounds"][1] == pytest.approx([25, 25], rel=1e-4)


@pytest.mark.parametrize("plane", ["z", "w=1", "z=", "z=high", "0,0,0=1", "1,2=3", "1,2,x=3", "z=1e999", "1e999,0,0=1"])
def test_a_plane_that_is_none(hqmodel: Command, plane: str) -> None:
    ended = hqmodel("section", "ball.json", "--plane", plane, "-o", "a.svg")
    assert ended.status == 2
    assert ended.err.startswith("--plane: expected a plane such as z=0.2")
    assert ended.err.count("\n") == 1
    assert files() == {"ball.json"}


def test_a_plane_beside_the_body(hqmodel: Command) -> None:
    ended = hqmodel("section", "ball.json", "--plane", "z=3", "-o", "a.svg")
    assert (ended.status, ended.err) == (1, "ball.json: no outline: the plane misses the body\n")
    assert files() == {"ball.json"}


def test_another_ending(hqmodel: Command) -> None:
    ended = hqmodel("section", "ball.json", "-o", "a.pdf")
    assert ended.status == 2
    assert "expected a file name that ends in .svg or .dxf, got .pdf" in ended.err
