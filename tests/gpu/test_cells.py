"""The cells: no list lacks a term that matters, and lists stay short where shapes are scattered."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from hqmodel.field import Terms, region, value
from hqmodel.gpu.cells import Cells, cells
from hqmodel.gpu.packing import NEGLIGIBLE, Frame, Packed, pack
from hqmodel.model import Scene, Shape

from .scenes import ball, random_scene, solid

Array = NDArray[np.float64]


def _cells(scene: Scene) -> tuple[Cells, Packed, Frame]:
    terms, where = Terms.of(scene), region(scene)
    frame = Frame.of(where)
    packed = pack(scene, terms, frame)
    return cells(packed, frame.local(where.low), frame.local(where.high)), packed, frame


def _listed(grid: Cells, local: Array, count: int) -> NDArray[np.bool_]:
    """(n, count) whether each term is listed where the points lie."""
    x, y, z = np.clip(np.floor((local - grid.low) / grid.size), 0, np.array(grid.counts) - 1).astype(int).T
    number = (z * grid.counts[1] + y) * grid.counts[0] + x
    listed = np.zeros((len(grid.first) - 1, count), dtype=bool)
    listed[np.repeat(np.arange(len(listed)), np.diff(grid.first)), grid.terms] = True
    return listed[number]


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("signs", [False, True])
def test_terms_that_are_not_listed_are_negligible(seed: int, signs: bool) -> None:
    rng = np.random.default_rng(seed)
    scene = random_scene(rng, 6, signs=signs)
    grid, _, frame = _cells(scene)
    terms, where = Terms.of(scene), region(scene)
    points = rng.uniform(where.low, where.high, size=(3000, 3))
    share = np.array([value(terms.keep(np.arange(len(terms)) == k), points) for k in range(len(terms))]).T + terms.level
    absent = np.where(_listed(grid, frame.local(points), len(terms)), 0.0, np.abs(share))
    assert np.max(np.sum(absent, axis=1)) <= NEGLIGIBLE * terms.level


def _row(count: int) -> Scene:
    shapes = tuple(ball((3.0 * i, 0.3 * i, 0.0)).shapes[0].changed(hardness=8.0) for i in range(count))
    return Scene(shapes=shapes)


def test_lists_do_not_grow_with_the_number_of_scattered_shapes() -> None:
    few, many = (_cells(_row(count))[0] for count in (4, 64))
    assert many.rows <= 2 * few.rows <= 16
    assert len(many.terms) < 20 * len(few.terms)


def test_texels_lead_from_each_cell_to_its_list() -> None:
    grid, packed, _ = _cells(_row(5))
    texels = grid.texels(packed.length)
    heads = texels[: len(grid.first) - 1]
    assert heads[:, 1].sum() == len(grid.terms)
    for number in np.flatnonzero(heads[:, 1]):
        start, count = (int(part) for part in heads[number, :2])
        own = texels[start - packed.length : start - packed.length + count, 0]
        assert own.tolist() == grid.terms[grid.first[number] : grid.first[number + 1]].tolist()


def test_a_shape_without_end_is_listed_everywhere() -> None:
    endless: Shape = solid(2.0).shapes[0]
    strips = (*endless.strips[:2], endless.strips[2].changed(sign=-1))
    scene = Scene(shapes=(endless.changed(strips=strips), ball((0.0, 0.0, 1.0), 0.5).shapes[0]), bounds=((-3,) * 3, (3,) * 3))
    grid, _, _ = _cells(scene)
    assert np.count_nonzero(grid.terms == 0) == len(grid.first) - 1
