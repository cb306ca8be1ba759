"""The dialog in front, as a modal window; the others wait behind it until it is answered."""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import imgui

from ..asks import (
    About,
    ChooseFile,
    Dialog,
    ExportAs,
    Exported,
    FilmAs,
    Filmed,
    ImportAs,
    Overwrite,
    Palette,
    Problem,
    Recover,
    Shortcuts,
    Tour,
    Unsaved,
)
from ..intents import Answer, Ask, Intent
from ..session import Session
from . import about, chooser, exporting, filming, importing, palette, problem, recover, shortcuts, tour, unsaved
from .buttons import untouched

_DRAWN: dict[type[Dialog], Callable[[Dialog], list[Intent]]] = {
    Unsaved: unsaved.draw,
    Overwrite: unsaved.draw_overwrite,
    Recover: recover.draw,
    ChooseFile: chooser.draw,
    Problem: problem.draw,
    ExportAs: exporting.draw,
    Exported: exporting.draw_report,
    FilmAs: filming.draw,
    Filmed: filming.draw_report,
    ImportAs: importing.draw,
    Palette: palette.draw,
    Shortcuts: shortcuts.draw,
    Tour: tour.draw,
    About: about.draw,
}
_FLAGS = imgui.WindowFlags_.always_auto_resize | imgui.WindowFlags_.no_saved_settings


def draw(session: Session) -> list[Intent]:
    """What the dialog in front answers; Esc is no."""
    if not session.dialogs:
        return []
    dialog = session.dialogs[-1]
    title = _title(dialog)
    if not imgui.is_popup_open(title):
        imgui.open_popup(title)
    middle = imgui.get_main_viewport().get_center()
    imgui.set_next_window_pos(middle, imgui.Cond_.always, (0.5, 0.5))
    if not imgui.begin_popup_modal(title, None, _FLAGS)[0]:
        return []
    intents = _DRAWN[type(dialog)](dialog)
    if not intents and imgui.is_key_pressed(imgui.Key.escape) and untouched():
        intents = [Answer()]
    if any(isinstance(intent, (Answer, Ask)) for intent in intents):
        imgui.close_current_popup()
    imgui.end_popup()
    return intents


def _title(dialog: Dialog) -> str:
    match dialog:
        case Problem(title=title):
            return title
        case ChooseFile(purpose=purpose):
            return {"open": "Open", "save": "Save As", "export": "Export To", "import": "Import"}[purpose]
        case Unsaved():
            return "Unsaved Changes"
        case Overwrite():
            return "Changed Meanwhile"
        case Recover():
            return "Unsaved Work Found"
        case ExportAs():
            return "Export"
        case FilmAs():
            return "Export Animation"
        case ImportAs():
            return "Fit"
        case Exported() | Filmed():
            return "Exported"
        case Palette():
            return "Commands"
        case Shortcuts():
            return "Shortcuts"
        case Tour():
            return "Welcome to hqmodel"
    return "About hqmodel"
