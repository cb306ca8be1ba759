"""`fit`: from points to a scene, with what can be said of how well it fits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from hqmodel.model import Scene

from .bodies import Array, Bodies
from .cloud import FitError, Frame, prepared
from .distance import distances
from .lone import Step, lone_body
from .parts import several_bodies
from .scene import scene_of
from .solve import Noise
from .symmetry import mirrored_frame
from .told import Tell, Told

MOST_PARTS, MOST_STRIPS = 64, 32
# As many as are made when nobody says how many.
AUTO_PARTS = 16
# Bytes of an array that is made and freed at once: from then on glibc keeps memory for arrays up to that size instead of taking
# it from the system and giving it back each time, which is half the time of a fit.
_KEPT = 31 << 20
# Points whose distances are worked out at once.
_CHUNK = 20_000


@dataclass(frozen=True, eq=False)
class Report:
    """How the fit came about and how well it fits: distances are shares of the cloud's diagonal.

    `median`, `most` (of nine points in ten) and `largest` are of all points, outliers included; `noise` is the deviation of
    those that are none, `outliers` the share of those that are. `symmetric` tells whether several parts were laid about a mirror
    plane of the cloud.
    """

    points: int
    diagonal: float
    median: float
    most: float
    largest: float
    noise: float
    outliers: float
    parts: int
    strips: int
    symmetric: bool
    steps: tuple[Step, ...]

    def plain(self) -> dict[str, Any]:
        """The report as plain data."""
        return {**self.__dict__, "steps": [dict(step.__dict__) for step in self.steps]}


@dataclass(frozen=True, eq=False)
class Fit:
    """A scene fitted to points; `residuals` (N,) are their distances from its surface in world units, positive outside."""

    scene: Scene
    residuals: Array
    report: Report


def fit(
    points: ArrayLike,
    normals: ArrayLike | None = None,
    *,
    parts: int | Literal["auto"] = 1,
    strips: int = 8,
    tolerance: float = 2e-4,
    seed: int = 0,
    progress: Tell | None = None,
) -> Fit:
    """Fit hyperquadrics to points (N, 3) of a surface, in any order, with outliers, noise and gaps.

    `normals` (N, 3), of any length, point outward and help. `parts` is the largest number of bodies, a pair of mirror images
    counting as one, or "auto"; `strips` the largest number of strips in each. Distances below `tolerance`, a share of the cloud's
    diagonal, count as none. The same points and `seed` give the same scene. `progress` is told the share done (0..1) and what is
    being done; whatever it raises ends the work.

    Raises FitError, with one line, for numbers out of range and for points that are no surface of a body.
    """
    _check(parts, strips, tolerance)
    np.empty(_KEPT, dtype=np.uint8)
    tell = Told(progress or _silent)
    tell(0.0, "Looking at the points")
    rng = np.random.default_rng(seed)
    where = np.asarray(points, dtype=float)
    cloud = prepared(where, normals, rng)
    frame = mirrored_frame(cloud) if parts != 1 else None
    if parts == 1:
        solution, steps = lone_body(cloud, strips, tolerance, rng, tell)
    else:
        cloud = cloud if frame is None else cloud.reframed(frame)
        most = AUTO_PARTS if parts == "auto" else parts
        solution, steps = several_bodies(cloud, most, strips, tolerance, rng, tell, frame is not None)
    tell(0.97, "Measuring")
    residuals = _residuals(solution.bodies, cloud.frame, where, tell)
    tell(1.0, "Done")
    report = _report(solution.bodies, solution.noise, cloud.frame, residuals, steps, frame is not None)
    return Fit(scene_of(solution.bodies, cloud.frame), residuals, report)


def _silent(share: float, doing: str) -> None:
    pass


def _check(parts: int | str, strips: int, tolerance: float) -> None:
    if parts != "auto" and (not isinstance(parts, int) or not 1 <= parts <= MOST_PARTS):
        raise FitError(f'parts: expected a whole number from 1 to {MOST_PARTS} or "auto", got {parts!r}')
    if not 3 <= strips <= MOST_STRIPS:
        raise FitError(f"strips: expected a whole number from 3 to {MOST_STRIPS}, got {strips}")
    if not 1e-6 <= tolerance <= 0.1:
        raise FitError(f"tolerance: expected a share of the diagonal from 1e-06 to 0.1, got {tolerance:g}")


def _residuals(bodies: Bodies, frame: Frame, points: Array, tell: Told) -> Array:
    result = np.empty(len(points))
    for start in range(0, len(points), _CHUNK):
        tell.again()
        here = slice(start, start + _CHUNK)
        result[here] = distances(bodies, frame.local(points[here])) * frame.size
    return result


def _report(bodies: Bodies, noise: Noise, frame: Frame, residuals: Array, steps: Sequence[Step], symmetric: bool) -> Report:
    median, most, largest = np.quantile(np.abs(residuals), (0.5, 0.9, 1.0)) / frame.size
    return Report(
        points=len(residuals),
        diagonal=frame.size,
        median=float(median),
        most=float(most),
        largest=float(largest),
        noise=noise.sigma,
        outliers=noise.outliers,
        parts=len(bodies),
        strips=len(bodies.owner),
        symmetric=symmetric,
        steps=tuple(steps),
    )
