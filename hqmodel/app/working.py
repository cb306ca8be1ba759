"""Long work begun in the background, one piece at a time, and what follows when it has ended."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING

from hqmodel import edit, film
from hqmodel.model import Scene

from .asks import Exported, ExportSettings, Filmed, FilmSettings, ImportSettings, Problem
from .editing import release
from .export import ExportJob
from .filming import FilmJob
from .importing import FitJob, Fitted
from .intents import Choose, Edit

if TYPE_CHECKING:
    from .session import Session


def export(session: Session, settings: ExportSettings) -> None:
    """Begin to write the scene as a mesh."""
    release(session)
    session.job = ExportJob(session.scene, settings, session.wake)
    session.say(f"Exporting {settings.path.name}")


def shoot(session: Session, settings: FilmSettings) -> None:
    """Begin to film the scene, as it is seen now."""
    release(session)
    scene, view = session.scene, session.view
    moving = None if settings.animation is None else edit.animation_at(scene, settings.animation)
    motion = (moving, settings.turning, settings.frames, settings.seconds)
    plan = film.Plan(scene, view.camera, *motion, settings.size, view.mode, settings.whole, view.cut)
    session.job = FilmJob(plan, settings.path, session.wake)
    session.say(f"Filming {settings.path.name}")


def fit(session: Session, settings: ImportSettings) -> None:
    """Begin to fit hyperquadrics to a file's points."""
    release(session)
    session.job = FitJob(settings, session.wake)
    session.say(f"Fitting {settings.path.name}")


def look_after(session: Session) -> None:
    """Once a frame: when the work has ended, tell how."""
    job = session.job
    if job is None or job.running:
        return
    session.job = None
    match job.outcome:
        case None:
            session.say(f"{job.noun} cancelled; {job.aftermath}")
        case Problem():
            session.dialogs.append(job.outcome)
            session.say(f"{job.noun} failed")
        case Exported():
            session.exported = job.outcome
            session.dialogs.append(job.outcome)
            session.say(f"Exported {job.outcome.path.name}")
        case Filmed():
            session.dialogs.append(job.outcome)
            session.say(f"Exported {job.outcome.files[0].name}: {job.outcome.told}")
        case Fitted():
            _take_in(session, job.outcome)


def _take_in(session: Session, fitted: Fitted) -> None:
    """What was fitted comes in place of a scene nobody has touched, else beside what there is."""
    fresh = session.document.path is None and not session.history.labels
    count = 0 if fresh else len(session.scene.shapes)

    def change(scene: Scene) -> Scene:
        return fitted.scene if fresh else reduce(edit.add_shape, fitted.scene.shapes, scene)

    session.apply([Edit("Fit", change), Choose(tuple(range(count, count + len(fitted.scene.shapes))))])
    session.cloud = fitted.cloud
    if fresh:
        session.frame(session.region)
    session.say(fitted.told)
