"""Numbers stay numbers over all that the format permits; `make reliability` looks at thousands of scenes."""

from __future__ import annotations

import moderngl
import pytest

from hqmodel.gpu import offscreen

from .wild import check, drawn


def test_fields_bounds_regions_and_meshes_of_wild_scenes() -> None:
    assert {check(seed) for seed in range(16)} >= {"a mesh", "bounds", "no surface"}


@pytest.fixture(scope="module")
def ctx() -> moderngl.Context:
    return offscreen()


@pytest.mark.parametrize("seed", range(3))
def test_pictures_of_wild_scenes(seed: int, ctx: moderngl.Context) -> None:
    with ctx:
        drawn(seed, ctx)
