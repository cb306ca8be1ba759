"""The colour of the body: the shapes' colours mixed by how much each adds at a point."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from hqmodel.model import Scene

from .evaluate import term_weights
from .terms import Array, Terms


def mixed_colors(scene: Scene, terms: Terms, points: ArrayLike) -> Array:
    """sRGB colours (..., 3) at points (..., 3): those of the shapes that add, mixed in linear light by their shares of the sum.

    Where a negative shape has carved, the body shows the colour it has inside.
    """
    adding = terms.keep(terms.positive)
    colors = np.array([scene.shapes[i].color for i in adding.term_source], dtype=float).reshape(-1, 3)
    if len(np.unique(colors, axis=0)) == 1:
        return np.broadcast_to(colors[0], np.shape(points)).copy()
    return linear_to_srgb(term_weights(adding, points) @ srgb_to_linear(colors))


def srgb_to_linear(color: Array) -> Array:
    """sRGB components in 0..1 to linear light (IEC 61966-2-1)."""
    return np.where(color <= 0.04045, color / 12.92, ((np.maximum(color, 0) + 0.055) / 1.055) ** 2.4)


def linear_to_srgb(color: Array) -> Array:
    """Linear light in 0..1 to sRGB components (IEC 61966-2-1)."""
    return np.where(color <= 0.0031308, color * 12.92, 1.055 * np.maximum(color, 0.0031308) ** (1 / 2.4) - 0.055)
