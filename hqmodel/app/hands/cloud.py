"""The points that the clay was fitted to, over the picture, coloured by how far they are from its surface."""

from __future__ import annotations

import numpy as np

from ..importing import Cloud
from ..tools.aim import Aim
from .overlay import Color, Pen

# The share of the points' extent from which on a distance has the full colour; inside, on the surface, outside.
_FAR = 0.01
_COLORS = np.array([(0.25, 0.50, 0.95, 0.9), (0.92, 0.92, 0.88, 0.7), (0.95, 0.45, 0.15, 0.9)])
_STEPS = 9


def draw(pen: Pen, aim: Aim, cloud: Cloud) -> None:
    """Each point as a small square, in one of a few colours."""
    seen = aim.pixel(cloud.points)
    shown = np.all(np.isfinite(seen), axis=1) & np.all((seen >= 0) & (seen < aim.size), axis=1)
    place = np.clip(cloud.distances / _FAR, -1, 1)
    step = np.rint((place + 1) / 2 * (_STEPS - 1)).astype(int)
    for number in range(_STEPS):
        pen.dots(seen[shown & (step == number)], _color(2 * number / (_STEPS - 1) - 1))


def _color(place: float) -> Color:
    """Between the three colours, from -1 (inside) to 1 (outside)."""
    r, g, b, a = (float(np.interp(place, (-1, 0, 1), _COLORS[:, part])) for part in range(4))
    return r, g, b, a
