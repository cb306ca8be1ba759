"""Strips in the plane: the two lines that bound each (Hanson 1988, section 2.3 and figure 5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .terms import Array


def bounding_lines(normal: ArrayLike, offset: float, middle: ArrayLike, far: float) -> Array:
    """The lines where normal . (x, y) + offset is -1 and 1, as the ends (2, 2, 2) of two pieces that reach so far to either side.

    To either side of the point of each that is nearest to `middle` (2,); both run the same way.
    """
    n, middle = np.asarray(normal, dtype=float), np.asarray(middle, dtype=float)
    size = float(np.linalg.norm(n))
    across, along = n / size, np.array([-n[1], n[0]]) / size
    foot = middle - across * (across @ middle)
    sides = (np.array([-1.0, 1.0]) - offset) / size
    return foot + sides[:, None, None] * across + np.array([[-far], [far]]) * along
