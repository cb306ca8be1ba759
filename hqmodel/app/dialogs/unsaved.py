"""Asked before work would be lost: one's own by leaving, or another's by saving over it."""

from __future__ import annotations

from imgui_bundle import imgui

from ..asks import Dialog, Overwrite, Unsaved
from ..intents import Answer, Intent
from .buttons import buttons

_ANSWERS = {"Save": "save", "Don't Save": "discard", "Cancel": None}
_OVERWRITE_ANSWERS = {"Save As...": "elsewhere", "Overwrite": "overwrite", "Cancel": None}


def draw(dialog: Dialog) -> list[Intent]:
    assert isinstance(dialog, Unsaved)
    imgui.text_unformatted(f"Save the changes to {dialog.name}?")
    imgui.text_disabled("Without saving they are lost.")
    pressed = buttons(list(_ANSWERS))
    return [] if pressed is None else [Answer(_ANSWERS[pressed])]


def draw_overwrite(dialog: Dialog) -> list[Intent]:
    assert isinstance(dialog, Overwrite)
    imgui.text_unformatted(f"{dialog.path.name} was changed by another program since it was opened here.")
    imgui.text_disabled("Overwriting replaces that; it is kept among the earlier versions.")
    pressed = buttons(list(_OVERWRITE_ANSWERS))
    return [] if pressed is None else [Answer(_OVERWRITE_ANSWERS[pressed])]
