"""How many triangles a mesh will have is told by a coarse one, creases or not."""

from __future__ import annotations

import pytest

from hqmodel import load
from hqmodel.mesh import COARSE, Count, polygonize


@pytest.mark.parametrize("name", ["owl", "brilliant", "pebble", "fig13-dodecahedron"])
def test_triangles_are_about_right(name: str) -> None:
    scene = load(name)
    coarse = polygonize(scene, COARSE, shading=False)
    count = Count.of(coarse)
    assert sum(count) == count.at(COARSE) == len(coarse.faces)
    assert count.at(200) == pytest.approx(len(polygonize(scene, 200, shading=False).faces), rel=0.2)
    assert count.finest(count.at(1234)) == pytest.approx(1234)
