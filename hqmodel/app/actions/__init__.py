"""The one table of actions: what menus, shortcuts and the list of shortcuts are made of."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..asks import About, Palette, Shortcuts, Tour
from ..catalogue import catalogue
from ..editing import release
from .action import Action
from .clay import CLAY
from .document import DOCUMENT
from .looks import HIDDEN, LOOKS
from .menus import MENUS, RECENT, Entry

if TYPE_CHECKING:
    from ..session import Session

__all__ = ["ACTIONS", "HIDDEN", "MENUS", "RECENT", "Action", "Entry", "perform"]


def perform(session: Session, name: str) -> None:
    """Do the action of that name, unless it can't be done now."""
    action = ACTIONS[name]
    if action.enabled(session):
        action.run(session)


def _palette(session: Session) -> None:
    release(session)
    session.dialogs.append(Palette(catalogue(session, ACTIONS, MENUS)))


HELP: dict[str, Action] = {
    "palette": Action("Find a Command...", _palette, ("Ctrl+P",)),
    "shortcuts": Action("Shortcuts", lambda s: s.dialogs.append(Shortcuts(catalogue(s, ACTIONS, MENUS))), ("F1",)),
    "tour": Action("Tour", lambda s: s.dialogs.append(Tour())),
    "about": Action("About", lambda s: s.dialogs.append(About())),
}
ACTIONS: dict[str, Action] = {**DOCUMENT, **CLAY, **LOOKS, **HELP}
