"""A film in the background."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from hqmodel import edit, film, gpu

from .asks import Filmed
from .jobs import Job


class FilmJob(Job[Filmed]):
    """Draws and writes a film; stopped, it leaves the files that were there before.

    It draws in a context of its own, off screen, which belongs to the job's thread: the window's is left alone.
    """

    noun, aftermath = "Film", "nothing was written"

    def __init__(self, plan: film.Plan, path: Path, wake: Callable[[], None] = lambda: None) -> None:
        self._plan, self._path = plan, path
        super().__init__(wake)

    def _work(self) -> Filmed:
        files = film.shoot(self._plan, self._path, self._report)
        width, height = self._plan.size
        return Filmed(tuple(files), f"{self._plan.frames} frames, {self._plan.seconds:g} s, {width} x {height} pixels")

    def _faults(self) -> tuple[type[Exception], ...]:
        return edit.EditError, film.FilmError, gpu.GpuError

    def _place(self) -> str:
        return str(self._path)
