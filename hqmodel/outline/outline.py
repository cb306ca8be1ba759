"""The outline of a scene's body in a plane, as a plain value."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hqmodel.field import Plane, Terms, region
from hqmodel.model import Scene

from .contour import Array, loops, slice_of
from .curves import arc_lengths, enclosed, fitted, flattened

# How near the curves are to the true outline, as a share of its longer side, unless asked otherwise.
PRECISE = 2e-5


class OutlineError(Exception):
    """There is no outline to draw, and the message says why in one line."""


@dataclass(frozen=True, eq=False)
class Outline:
    """Closed chains of cubic Bézier curves, control points (m, 4, 2) each, in the plane's coordinates and world units.

    The body lies to their left: they go round bodies counter-clockwise and round holes clockwise. `tolerance` is how far they
    may be from the true outline.
    """

    plane: Plane
    curves: tuple[Array, ...]
    tolerance: float

    @property
    def area(self) -> float:
        """What the outline encloses, holes taken away."""
        return sum(enclosed(chain) for chain in self.curves)

    @property
    def length(self) -> float:
        """Of all the curves together."""
        return float(sum(np.sum(arc_lengths(chain)) for chain in self.curves))

    @property
    def bounds(self) -> tuple[Array, Array]:
        """The corners (2,) of the rectangle that holds it, to within the tolerance."""
        points = np.concatenate(self.polygons())
        return np.min(points, axis=0), np.max(points, axis=0)

    def polygons(self, tolerance: float | None = None) -> list[Array]:
        """The curves as closed polygons (n, 2), the first point not repeated, no further from them than `tolerance`."""
        return [flattened(chain, tolerance or self.tolerance) for chain in self.curves]

    def scaled(self, factor: float) -> Outline:
        """All of it larger by that factor about u = v = 0."""
        return Outline(self.plane, tuple(chain * factor for chain in self.curves), self.tolerance * factor)


def outline(scene: Scene, plane: Plane | None = None, precision: float = PRECISE) -> Outline:
    """The scene's body where the plane (z = 0 unless given) cuts it.

    `precision` is the largest distance of the curves from the true outline, as a share of its longer side. Raises OutlineError
    when the plane misses the body, when the body has no end, or where the precision is out of its range.
    """
    if not 1e-6 <= precision <= 0.1:
        raise OutlineError(f"precision: expected a number from 1e-06 to 0.1, got {precision:g}")
    plane = plane or Plane()
    terms = Terms.of(scene)
    where = region(scene, terms)
    if where.empty:
        raise OutlineError("no outline: the field is below its level everywhere")
    if not where.bounded:
        raise OutlineError("bounds: expected a box to cut the body by, as it runs on without end, got none")
    body = slice_of(terms, where, plane)
    found = loops(body) if body is not None else []
    if body is None or not found:
        raise OutlineError("no outline: the plane misses the body")
    tolerance = precision * body.size
    return Outline(plane, tuple(fitted(body, loop, tolerance) for loop in found), tolerance)
