"""Actions on the open preset as a whole: opened, saved, imported to, exported and left."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

from hqmodel import edit, files

from .. import filing
from ..asks import ChooseFile, ExportAs, ExportSettings, FilmAs, FilmSettings, New, Problem, Quit
from ..editing import release
from ..forecast import Forecast
from .action import Action

if TYPE_CHECKING:
    from ..session import Session

_UNBOUNDED = "The body runs on without end: give it bounds in the Scene panel, the box that it is cut by."
# Seconds that a turn around the body takes, unless something else says so.
_TURN = 6.0
# Pixels across.
_WIDE = 640


def _save(session: Session) -> None:
    release(session)
    filing.save(session, session.document.path)


def _open(session: Session) -> None:
    session.dialogs.append(ChooseFile("open", filing.folder(session)))


def _save_as(session: Session) -> None:
    release(session)
    filing.save(session, None)


def _has_versions(session: Session) -> bool:
    path = session.document.path
    return path is not None and files.backup_folder(path).is_dir()


def _versions(session: Session) -> None:
    if session.document.path is not None:
        session.dialogs.append(ChooseFile("open", files.backup_folder(session.document.path)))


def _import(session: Session) -> None:
    from hqmodel.fit import FORMATS  # late: it takes a second, and few need it

    session.dialogs.append(ChooseFile("import", filing.folder(session), endings=FORMATS))


def _show_cloud(session: Session) -> None:
    session.cloud_hidden = not session.cloud_hidden


def _working(session: Session) -> bool:
    return session.job is not None


def _stop_export(session: Session) -> None:
    if session.job is not None:
        session.job.cancel()


def _export(session: Session) -> None:
    release(session)
    if session.region.empty or not session.region.bounded:
        reason = "there is no body to export" if session.region.empty else _UNBOUNDED
        session.dialogs.append(Problem("Nothing to export", (reason,)))
        return
    path = filing.folder(session) / session.document.file_name
    told = Forecast(session.scene, session.wake).told
    session.dialogs.append(ExportAs(ExportSettings(path.with_suffix(".glb")), told))


def _film(session: Session) -> None:
    """Of the animation that is picked, or else the first, or else a turn around the body; its sides are as the viewport's."""
    release(session)
    found: dict[int, tuple[str, float]] = {}
    for index in range(len(session.scene.animations)):
        with suppress(edit.EditError):  # the timeline says what is wrong with it
            animation = edit.animation_at(session.scene, index)
            found[index] = animation.name or f"Animation {index + 1}", animation.duration
    chosen = session.animation if session.animation in found else next(iter(found), None)
    seconds = _TURN if chosen is None else found[chosen][1]
    path = (filing.folder(session) / session.document.file_name).with_suffix(".gif")
    size = _WIDE, max(16, 2 * round(_WIDE * session.size[1] / session.size[0] / 2))
    session.dialogs.append(FilmAs(FilmSettings(path, chosen, chosen is None, seconds, size=size), found))


DOCUMENT: dict[str, Action] = {
    "new": Action("New", lambda s: filing.leave(s, New()), ("Ctrl+N",)),
    "open": Action("Open...", _open, ("Ctrl+O",)),
    "save": Action("Save", _save, ("Ctrl+S",)),
    "save as": Action("Save As...", _save_as, ("Ctrl+Shift+S",)),
    "versions": Action("Earlier Versions...", _versions, (), _has_versions),
    "export": Action("Export...", _export, ("Ctrl+E",), lambda s: s.job is None),
    "film": Action("Export Animation...", _film, ("Ctrl+Shift+E",), lambda s: s.job is None),
    "import": Action("Import and Fit...", _import, ("Ctrl+I",), lambda s: s.job is None),
    "stop export": Action("Stop What Is Under Way", _stop_export, (), _working),
    "cloud": Action("Imported Points", _show_cloud, (), lambda s: s.cloud is not None, lambda s: not s.cloud_hidden),
    "quit": Action("Quit", lambda s: filing.leave(s, Quit()), ("Ctrl+Q",)),
}
