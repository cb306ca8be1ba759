"""The log ratio made nearly linear across the surface: what is interpolated, and what Newton's steps are taken in."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .evaluate import log_gradient
from .terms import HUGE, Array, Terms

# A lone shape's H/C below which its root is no longer taken: L has no digits of it left.
_CENTRE = 1e-12


def near_linear(terms: Terms, ratio: Array) -> Array:
    """L made nearly linear across the surface, (...,): (H/C)^(1/gamma) turned inside out, for a lone shape.

    Same sign as L, and it rises with it everywhere; what to hand to anything that interpolates.
    """
    return _straightened(terms, ratio)[0]


def near_linear_single(terms: Terms, ratio: Array, rounding: float = 0.0) -> NDArray[np.float32]:
    """The same to single precision, some five times as quickly; the sign, and only it, is exact.

    Negative, too, where the field is no further above its level than `rounding`.
    """
    way = _straightening(terms.chosen_from or terms)
    share = 1.0 - ratio / way.hard
    root = np.log(np.clip(share, way.least, 1e37).astype(np.float32))
    root /= np.float32(way.steep)
    np.exp(root, out=root)
    deep = share < way.least
    if deep.any():
        root[deep] *= way.beyond(way.further(share[deep]))
    size = np.maximum(np.abs(1.0 - root, out=root), np.float32(1e-37), out=root)
    return np.where(ratio > rounding * way.hard * way.steep, size, -size)


def near_linear_gradient(terms: Terms, points: ArrayLike) -> tuple[Array, Array]:
    """The near-linear field (...,) and its gradient (..., 3) at points (..., 3).

    Their quotient is a Newton step that neither creeps from outside nor leaps from inside.
    """
    ratio, slope = log_gradient(terms, points)
    values, rate = _straightened(terms, ratio)
    with np.errstate(over="ignore"):
        slope *= rate[..., None]
    return values, np.clip(slope, -HUGE, HUGE, out=slope)


def _straightened(terms: Terms, ratio: Array) -> tuple[Array, Array]:
    """The near-linear field (...,) and how fast it rises with L."""
    way = _straightening(terms.chosen_from or terms)
    share = np.clip(1.0 - ratio / way.hard, -HUGE, HUGE)
    held = np.maximum(share, way.least)
    root = held ** (1.0 / way.steep)
    rate = root / (held * (way.hard * way.steep))
    if np.any(share < way.least):
        grown = way.further(share)
        return 1.0 - root * way.beyond(grown), rate * grown ** (1.0 - way.steep)
    return 1.0 - root, rate


class _Straightening(NamedTuple):
    """How L becomes nearly linear: by the root `steep`, the largest exponent, of 1 - L/hard, for a lone shape H/C.

    `hard` is the most that L comes to where only one shape adds, and no less than the largest hardness. Where several add, or a
    hyperbolic one, L may be more: from the share `least` on, it goes on as the root of what L is beyond that, with the slope that
    it has there.
    """

    hard: float
    steep: float
    least: float

    def further(self, share: Array) -> Array:
        """The root of what L is beyond the least share; 1 before that."""
        return np.maximum(1.0 + (self.least - share), 1.0) ** (1.0 / self.steep)

    def beyond(self, further: Array) -> Array:
        """What the root of the least share is to be multiplied by."""
        return 1.0 - (further - 1.0) / self.least


@lru_cache(maxsize=16)
def _straightening(terms: Terms) -> _Straightening:
    """For these terms: where some have been left out, that for all is to be used."""
    adds = terms.positive
    hardness = float(np.max(terms.hardness[adds], initial=1e-300))
    top = np.max(terms.log_coefficient[adds] + terms.hardness[adds] * terms.constant[adds], initial=-np.inf)
    hard = max(float(top) - (float(np.log(terms.level)) if terms.level > 0 else 0.0), hardness)
    steep = float(np.max(terms.outer, initial=1.0))
    return _Straightening(hard, steep, 1 / (2 + steep) if len(terms) > 1 or terms.hyperbolic else _CENTRE)
