"""Bounds contain, always; and they are tight where they can be."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hqmodel.field import Terms, box_bounds, log_ratio, relevant_terms, segment_bounds
from hqmodel.field.intervals import box_tops
from hqmodel.model import Scene

from ..cases import NAMES, case
from ..strategies import SEEDS, scenes


@given(scenes(), SEEDS, st.sampled_from([1e-6, 1e-2, 0.3, 3.0, 1e4]))
def test_boxes_contain(scene: Scene, seed: int, size: float) -> None:
    rng, terms = np.random.default_rng(seed), Terms.of(scene)
    low = rng.normal(size=(20, 3)) * 2
    high = low + size * rng.random((20, 3))
    lower, upper = box_bounds(terms, low, high)
    shares = np.concatenate([rng.random((30, 3)), np.eye(3), np.zeros((1, 3)), np.ones((1, 3))])
    inside = low[:, None] * (1 - shares) + high[:, None] * shares
    values = log_ratio(terms, np.clip(inside, low[:, None], high[:, None]))
    assert np.all(lower[:, None] <= values)
    assert np.all(values <= upper[:, None])


@given(scenes(), SEEDS, st.sampled_from([1e-7, 1e-2, 1.0, 1e3]))
def test_segments_contain(scene: Scene, seed: int, size: float) -> None:
    rng, terms = np.random.default_rng(seed), Terms.of(scene)
    start = rng.normal(size=(20, 3)) * 2
    end = start + size * rng.normal(size=(20, 3))
    lower, upper = segment_bounds(terms, start, end)
    shares = np.concatenate([rng.random(30), [0.0, 1.0]])[:, None]
    values = log_ratio(terms, start[:, None] + shares * (end - start)[:, None])
    assert np.all(lower[:, None] <= values)
    assert np.all(values <= upper[:, None])


@pytest.mark.parametrize("name", NAMES)
def test_bounds_close_in_on_the_value(name: str) -> None:
    terms = Terms.of(case(name).scene)
    points = case(name).rows("samples", "point")
    previous = np.full(len(points), np.inf)
    for size in (1e-1, 1e-3, 1e-5):
        lower, upper = box_bounds(terms, points - size, points + size)
        assert np.all(upper - lower <= previous)
        previous = upper - lower
    gap = previous / (1 + np.abs(log_ratio(terms, points)))
    assert np.quantile(gap, 0.9) < 0.1


@pytest.mark.parametrize("name", [name for name in NAMES if name.startswith("composite") or name in ("two_holes", "mirrored")])
def test_terms_left_out_do_not_move_the_surface(name: str) -> None:
    terms, rng = Terms.of(case(name).scene), np.random.default_rng(3)
    left_out = 0
    for centre in case(name).rows("surface_points", "point"):
        low, high = centre - 0.02, centre + 0.02
        local = relevant_terms(terms, low, high)
        left_out += len(terms) - len(local)
        points = rng.uniform(low, high, (200, 3))
        full = log_ratio(terms, points)
        near = np.abs(full) < 1.0
        np.testing.assert_allclose(log_ratio(local, points)[near], full[near], rtol=0, atol=1e-13)
    assert left_out or not name.startswith("composite")


@pytest.mark.parametrize("name", NAMES)
def test_tops_are_the_upper_bounds(name: str) -> None:
    terms = Terms.of(case(name).scene)
    low = np.random.default_rng(6).uniform(-2, 2, size=(300, 3))
    high = low + np.random.default_rng(7).uniform(0, 0.5, size=(300, 3))
    assert np.array_equal(box_tops(terms, low, high), box_bounds(terms, low, high)[1])
