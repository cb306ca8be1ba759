"""Points or a mesh brought in: hyperquadrics are fitted to them in the background, and the points shown over the clay."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

from hqmodel.model import Scene

from .asks import ImportSettings
from .jobs import Job

# Points that are shown, at most: enough to judge by, few enough to draw in every frame.
SHOWN = 4000


@dataclass(frozen=True, eq=False)
class Cloud:
    """Points (N, 3) to be seen over the clay, and how far outside its surface each was, (N,), as a share of their extent."""

    points: NDArray[np.float64]
    distances: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Fitted:
    """What a fit has come to: its scene, the points it was made to, and what to say of it."""

    scene: Scene
    cloud: Cloud
    told: str


class FitJob(Job[Fitted]):
    """Fits hyperquadrics to a file's points or mesh; stopped, it changes nothing.

    It writes nothing either: once it is stopped nobody has to wait until a file that is just being read is at its end.
    """

    noun, aftermath = "Fit", "nothing was changed"

    def __init__(self, settings: ImportSettings, wake: Callable[[], None] = lambda: None) -> None:
        self.settings = settings
        super().__init__(wake)

    @property
    def running(self) -> bool:
        return super().running and not self.cancelled

    def wait(self, seconds: float | None = None) -> None:
        if self.running:
            super().wait(seconds)

    def _work(self) -> Fitted:
        from hqmodel.fit import fit, read

        settings = self.settings
        self._report(0.0, "Reading")
        points, normals = read(settings.path)
        found = fit(points, normals, parts=settings.parts or "auto", strips=settings.strips, progress=self._report)
        report = found.report
        every = ceil(len(points) / SHOWN)
        cloud = Cloud(np.asarray(points)[::every], found.residuals[::every] / report.diagonal)
        counts = f"{report.parts} parts, {report.strips} strips"
        told = f"{counts}: half of {report.points:,} points are within {report.median:.2%} of the size"
        return Fitted(found.scene.changed(name=settings.path.stem), cloud, told)

    def _faults(self) -> type[Exception]:
        from hqmodel.fit import FitError

        return FitError

    def _place(self) -> str:
        return str(self.settings.path)
