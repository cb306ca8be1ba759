"""An export in the background: a thread of its own, progress to look at, and a way to stop it that leaves nothing behind."""

from __future__ import annotations

import threading
import traceback
from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

from hqmodel import files
from hqmodel.model import Scene

from .asks import Dialog, Exported, ExportSettings, Problem

TITLE = "Export failed"


class _Cancelled(BaseException):
    """Raised inside the work by its own progress reports; no `except Exception` on the way may swallow it."""


class ExportJob:
    """Writes the scene as a mesh. `progress` and `stage` say how far it is; `outcome` is set when it has ended.

    `wake` is called, from the job's thread, whenever there is something new to show.
    """

    def __init__(self, scene: Scene, settings: ExportSettings, wake: Callable[[], None] = lambda: None) -> None:
        self.settings = settings
        self.progress = 0.0
        self.stage = "Starting"
        self.outcome: Dialog | None = None
        self.cancelled = False
        self._scene = scene
        self._wake = wake
        self._thread = threading.Thread(target=self._run, name="export", daemon=True)
        self._thread.start()

    @property
    def running(self) -> bool:
        return self._thread.is_alive()

    def cancel(self) -> None:
        """Stop at the next report of progress; the file that was there before stays as it was."""
        self.cancelled = True

    def wait(self, seconds: float | None = None) -> None:
        """Until it has ended."""
        self._thread.join(seconds)

    def _run(self) -> None:
        from hqmodel.mesh import MeshError

        try:
            self.outcome = self._work()
        except _Cancelled:
            pass  # asked for; an outcome would only be in the way
        except MeshError as error:
            self.outcome = Problem(TITLE, (str(error),))
        except OSError as error:
            self.outcome = Problem(TITLE, (f"{self.settings.path}: {error.strerror or error}",))
        except Exception:  # a fault of ours must reach the screen, not die with the thread
            self.outcome = Problem(TITLE, ("This should not have happened; your work is untouched.", *_lines()))
        finally:
            self._wake()

    def _work(self) -> Exported:
        from hqmodel import mesh

        started = perf_counter()
        settings, suffix = self.settings, self.settings.path.suffix.lower()
        body = mesh.polygonize(self._scene, settings.resolution, self._report, target_faces=settings.target_faces)
        self._report(0.9, "Measuring")
        report = mesh.report(body)
        fitted = mesh.fitted(body, suffix, unit=settings.unit, size=settings.size, up=settings.up)
        if not settings.colors:
            fitted = replace(fitted, colors=None)
        if not settings.normals:
            fitted = replace(fitted, normals=None)
        self._report(0.95, "Writing")
        with files.atomic(settings.path) as stream:
            mesh.write(fitted, stream, suffix, self._scene.name)
            self._report(1.0, "Writing")
        return Exported(settings.path, perf_counter() - started, report)

    def _report(self, progress: float, stage: str) -> None:
        if self.cancelled:
            raise _Cancelled
        self.progress, self.stage = progress, stage
        self._wake()


def _lines() -> tuple[str, ...]:
    return tuple(traceback.format_exc().strip().splitlines()[-3:])
