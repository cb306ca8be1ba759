"""Loops compiled by Numba, with a cache and without."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from hqmodel.mesh.compiled import compiled
from hqmodel.mesh.cubes import AMBIGUOUS, tables, triangles


def test_what_no_file_holds_is_compiled_without_a_cache() -> None:
    """Numba keeps nothing of a function without a file, as of any where no folder may be written to."""
    names: dict[str, Callable[..., Any]] = {}
    exec("def root(x):\n    return x**0.5 if x >= 0 else 1 / (x - x)", names)
    root = compiled(names["root"])
    assert root(4.0) == 2.0
    assert np.isinf(root(-1.0))


def test_every_cell_has_its_triangles_in_the_tables() -> None:
    table = tables()
    for case in range(256):
        for joined in (0, int(AMBIGUOUS[case])):
            start, number = table.start[case, joined], table.number[case, joined]
            assert table.edges[start : start + 3 * number].tolist() == triangles(case, joined)
