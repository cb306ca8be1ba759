"""Presets opened, saved and left, and work brought back that was lost, without ever losing any on the way."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from hqmodel import files

from .asks import ChooseFile, Departure, ImportAs, ImportSettings, New, Open, Overwrite, Quit, Recover, Unsaved
from .document import ENDING, Document
from .editing import release
from .recovery import recovered, said

if TYPE_CHECKING:
    from .session import Session


def leave(session: Session, departure: Departure) -> None:
    """Go to another preset, or out; ask first where work would be lost."""
    release(session)
    if session.history.dirty:
        session.dialogs.append(Unsaved(session.document.name, departure))
    else:
        depart(session, departure)


def depart(session: Session, departure: Departure) -> None:
    """Go without asking. A preset that cannot be read is told of, and everything stays as it was."""
    match departure:
        case New():
            session.show(Document())
            session.say("New")
        case Open(path):
            _open(session, path)
        case Quit():
            if session.job is not None:
                session.job.cancel()
                session.job.wait()
            session.finished = True


def take(session: Session, path: Path) -> None:
    """A file was dropped on the window: a preset opens, points and meshes are fitted."""
    if path.suffix.lower() != ENDING:
        from hqmodel.fit import FORMATS  # late: it takes a second, and few need it

        if path.suffix.lower() in FORMATS:
            session.dialogs.append(ImportAs(ImportSettings(path)))
            return
    leave(session, Open(path))


def save(session: Session, path: Path | None, then: Departure | None = None) -> None:
    """Save to this file, or ask for one where there is none yet, and then go on to somewhere else.

    What another program wrote to the document's own file is not overwritten without a question.
    """
    session.after_saving = then
    if path is None:
        session.dialogs.append(ChooseFile("save", folder(session), session.document.file_name))
    elif path == session.document.path and session.document.overtaken:
        session.dialogs.append(Overwrite(path, then))
    else:
        write(session, path, then)


def save_chosen(session: Session, path: Path | None) -> None:
    """The answer to where to save; without one, whatever was to come after saving is off too."""
    if path is not None:
        save(session, path, session.after_saving)
    session.after_saving = None


def write(session: Session, path: Path, then: Departure | None = None) -> None:
    """Save to this file, whatever it holds."""
    try:
        kept = session.document.save(path, session.view.stored(session.scene.view))
    except (OSError, files.PresetError) as error:
        session.tell("Not saved", _lines(path, error))
        return
    session.keep(session.settings.opened(path))
    session.say(f"Saved {path.name}" if kept else f"Saved {path.name}; the version before it could not be kept")
    if then is not None:
        depart(session, then)


def folder(session: Session) -> Path:
    """Where file dialogs begin."""
    recent = [session.document.path, *map(Path, session.settings.recent)]
    return next((path.parent for path in recent if path is not None and path.parent.is_dir()), Path.home())


def offer(session: Session, lost: Iterable[files.Lost]) -> None:
    """Ask what to do with the work that windows left which did not end as they should."""
    found = tuple(lost)
    if found:
        session.dialogs.append(Recover(found))


def recover(session: Session, lost: files.Lost, others: Iterable[files.Lost]) -> None:
    """Go on where that window was; the other ones' work is offered again next time."""
    document, faults = recovered(lost)
    if document is None:
        offer(session, [lost, *others])
        session.tell("Not recovered", faults)
        return
    for other in others:
        other.release()
    session.show(document)
    session.say(f"Recovered {lost.origin.name}, as it was at {said(lost.time)}")
    lost.discard() if session.recovery.keep(session) else lost.release()
    if faults:
        session.tell("Recovered from the copy before the last one", faults)


def forget(session: Session, lost: files.Lost, others: Iterable[files.Lost]) -> None:
    """Throw that work away."""
    lost.discard()
    offer(session, others)


def _open(session: Session, path: Path) -> None:
    try:
        document = Document.opened(path)
    except (OSError, files.PresetError) as error:
        session.tell("Not opened", _lines(path, error))
        session.keep(session.settings.forgetting(path))
        return
    session.show(document)
    if document.path is not None:
        session.keep(session.settings.opened(document.path))
    session.say(f"Opened {document.name}")


def _lines(path: Path, error: OSError | files.PresetError) -> list[str]:
    if isinstance(error, files.PresetError):
        return str(error).splitlines()
    return [f"{path}: {error.strerror or error}"]
