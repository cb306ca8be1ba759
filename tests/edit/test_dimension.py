"""Solid scenes made flat, and flat ones solid."""

from __future__ import annotations

import pytest

from hqmodel.edit import PRIMITIVES, extruded, flattened, new_shape
from hqmodel.field import region
from hqmodel.model import Scene, Strip


@pytest.mark.parametrize("kind", PRIMITIVES)
def test_a_flat_primitive_is_the_one_that_would_have_been_added(kind: str) -> None:
    scene = flattened(Scene(shapes=(new_shape(kind),)))
    assert scene == Scene(dimension=2, shapes=(new_shape(kind, 2),))


@pytest.mark.parametrize("kind", PRIMITIVES)
def test_made_solid_again_it_has_an_end(kind: str) -> None:
    scene = extruded(flattened(Scene(shapes=(new_shape(kind),))))
    assert scene.dimension == 3
    where = region(scene)
    assert where.bounded
    assert not where.cut


def test_slanted_strips_lose_their_z_part_and_upright_ones_go() -> None:
    strips = (Strip(normal=(1.0, 0.0, 0.5)), Strip(normal=(0.0, 1.0, 0.0)), Strip(normal=(0.0, 0.0, 2.0)))
    shape = new_shape("ball").changed(strips=strips)
    scene = flattened(Scene(shapes=(shape, shape.changed(strips=strips[2:]))))
    assert [[strip.normal for strip in one.strips] for one in scene.shapes] == [[(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]]


def test_groups_that_lose_all_their_strips_go_too() -> None:
    shape = new_shape("cylinder")
    turned = shape.changed(strips=[strip.changed(normal=strip.normal[::-1]) for strip in shape.strips])
    lone = turned.changed(strips=[strip.changed(normal=(0.0, 0.0, 1.0)) if strip.group else strip for strip in turned.strips])
    assert flattened(Scene(shapes=(lone,))).shapes[0].groups == {}


def test_what_is_solid_stays_as_it_is() -> None:
    scene = Scene(shapes=(new_shape("block"),))
    assert extruded(scene) == scene
