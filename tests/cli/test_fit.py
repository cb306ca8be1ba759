"""fit: a preset from a file of points, and faults told in one line."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from hqmodel.files import load
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
