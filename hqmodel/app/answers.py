"""What follows from the answer to each dialog."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from . import actions, filing, working
from .asks import (
    ChooseFile,
    Dialog,
    ExportAs,
    ExportSettings,
    FilmAs,
    FilmSettings,
    ImportAs,
    ImportSettings,
    Open,
    Overwrite,
    Palette,
    Recover,
    Recovered,
    Tour,
    Unsaved,
)

if TYPE_CHECKING:
    from .session import Session


def take(session: Session, dialog: Dialog, value: object) -> None:
    """Go on from a dialog that was answered with this value, None for cancelled, and is closed by now."""
    match dialog, value:
        case Unsaved(departure=departure), "save":
            filing.save(session, session.document.path, departure)
        case Unsaved(departure=departure), "discard":
            filing.depart(session, departure)
        case Overwrite(path=path, departure=departure), "overwrite":
            filing.write(session, path, departure)
        case Overwrite(departure=departure), "elsewhere":
            filing.save(session, None, departure)
        case Recover(lost=lost), Recovered(lost=chosen, wanted=wanted):
            rest = tuple(one for one in lost if one is not chosen)
            filing.recover(session, chosen, rest) if wanted else filing.forget(session, chosen, rest)
        case Recover(lost=lost), None:
            for one in lost:
                one.release()
        case ChooseFile(purpose="open"), Path() as path:
            filing.leave(session, Open(path))
        case ChooseFile(purpose="save"), Path() | None as path:
            filing.save_chosen(session, path)
        case ChooseFile(purpose="export"), Path() as path:
            _export_to(session, path)
        case ChooseFile(purpose="import"), Path() as path:
            session.dialogs.append(ImportAs(ImportSettings(path)))
        case ImportAs(), ImportSettings() as settings:
            working.fit(session, settings)
        case Tour(), _:
            session.keep(session.settings.preferring(toured=True))
        case Palette(), str() as name:
            actions.perform(session, name)
        case ExportAs(), ExportSettings() as settings:
            working.export(session, settings)
        case FilmAs(), FilmSettings() as settings:
            working.shoot(session, settings)


def _export_to(session: Session, path: Path) -> None:
    """The chosen file goes into the export dialog that asked for it."""
    match session.dialogs[-1]:
        case ExportAs(settings=settings) as asking:
            session.dialogs[-1] = replace(asking, settings=replace(settings, path=path))
        case FilmAs(settings=filming) as asking:
            session.dialogs[-1] = replace(asking, settings=replace(filming, path=path))
