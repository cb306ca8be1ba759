"""A plane to cut by, and its own coordinates."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from .terms import Array, Terms


@dataclass(frozen=True)
class Plane:
    """The plane normal . x = offset in the world, drawn as seen from the side that the normal points to.

    Its coordinates (u, v) run to the right and up from the point of it that is nearest to the world's origin. Raises ValueError
    for a normal without a direction, and where a number is not finite.
    """

    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)
    offset: float = 0.0

    def __post_init__(self) -> None:
        if not np.all(np.isfinite([*self.normal, self.offset])) or not np.any(self.normal):
            raise ValueError(
                f"expected a finite normal that is not zero and a finite offset, got {self.normal} and {self.offset}"
            )

    @cached_property
    def axes(self) -> Array:
        """Rows: the directions of u, of v and of the normal in the world, (3, 3), orthonormal; z points up where it can."""
        n = np.array(self.normal) / np.max(np.abs(self.normal))
        n /= np.linalg.norm(n)
        right = np.array([-n[1], n[0], 0.0])
        size = float(np.linalg.norm(right))
        right = right / size if size > 1e-9 else np.array([1.0, 0.0, 0.0])
        return np.array([right, np.cross(n, right), n])

    @cached_property
    def origin(self) -> Array:
        """The world point (3,) at u = v = 0."""
        size = np.max(np.abs(self.normal))
        length = float(np.linalg.norm(np.array(self.normal) / size) * size)
        return self.axes[2] * (self.offset / length)

    def world(self, points: ArrayLike) -> Array:
        """World points (..., 3) at coordinates (..., 2)."""
        uv = np.asarray(points, dtype=float)
        return self.origin + uv[..., :1] * self.axes[0] + uv[..., 1:] * self.axes[1]

    def terms(self, terms: Terms) -> Terms:
        """The scene's terms over coordinates (u, v, height above the plane): every h stays affine, so all of `field` applies."""
        return replace(terms, normal=terms.normal @ self.axes.T, offset=terms.offset + terms.normal @ self.origin)
