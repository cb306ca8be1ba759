"""The field on lattices is the field at their points, whatever stands beside them; exponents of each kind are raised alike."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.random import default_rng

from hqmodel.field import Terms, lattice_log_ratio, log_ratio
from hqmodel.field.powers import power
from hqmodel.model import Scene

from ..strategies import SEEDS, scenes


@given(scenes(), SEEDS, st.sampled_from([1e-3, 1.0, 1e3]))
def test_lattices_to_the_last_bit(scene: Scene, seed: int, size: float) -> None:
    terms, rng = Terms.of(scene), default_rng(seed)
    x, y, z = (rng.normal(scale=size, size=(count, 5)) for count in (3, 4, 2))
    values = lattice_log_ratio(terms, x, y, z)
    points = np.stack(np.broadcast_arrays(x[:, None, None], y[:, None], z), axis=-1)
    assert np.array_equal(values, log_ratio(terms, points))
    assert np.array_equal(values[..., 2:3], lattice_log_ratio(terms, x[:, 2:3], y[:, 2:3], z[:, 2:3]))


@pytest.mark.parametrize("exponents", [[2.0, 2.0, 40.0] * 5, [1.0, 7.0, 64.0, 65.0], [0.6, 1.3, 2.5, 3.7], [3.0]])
def test_powers(exponents: list[float]) -> None:
    """In rows of any order, by multiplication or not."""
    rng = default_rng(0)
    base, raised = rng.uniform(0, 2, (len(exponents), 50)), np.array(exponents)
    assert power(base, raised) == pytest.approx(base ** raised[:, None], rel=1e-12)
    assert power(base[:1], raised) == pytest.approx(base[:1] ** raised[:, None], rel=1e-12)
