"""The colour of the body: the shapes' colours mixed by how much each adds at a point."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from hqmodel.model import Scene

from .evaluate import term_weights
from .terms import Array, Terms


def mixed_colors(scene: Scene, terms: Terms, points: ArrayLike) -> Array:
    """sRGB colours (..., 3) at points (..., 3): mixed in linear light by each term's share of the sum, carving ones included.

    Where a negative shape has cut, the cut takes its colour in the measure in which it holds back the sum.
    """
    if len({scene.shapes[i].color for i in terms.term_source}) == 1:
        color = np.array(scene.shapes[terms.term_source[0]].color)
        return np.broadcast_to(color, np.shape(points)).copy()
    linear = srgb_to_linear(np.array([scene.shapes[i].color for i in terms.term_source], dtype=float).reshape(-1, 3))
    return linear_to_srgb(term_weights(terms, points) @ linear)


def srgb_to_linear(color: Array) -> Array:
    """sRGB components in 0..1 to linear light (IEC 61966-2-1)."""
    return np.where(color <= 0.04045, color / 12.92, ((np.maximum(color, 0) + 0.055) / 1.055) ** 2.4)


def linear_to_srgb(color: Array) -> Array:
    """Linear light in 0..1 to sRGB components (IEC 61966-2-1)."""
    return np.where(color <= 0.0031308, color * 12.92, 1.055 * np.maximum(color, 0.0031308) ** (1 / 2.4) - 0.055)
