"""Save, don't save, or stay: asked before work would be lost."""

from __future__ import annotations

from imgui_bundle import imgui

from ..asks import Dialog, Unsaved
from ..intents import Answer, Intent
from .buttons import buttons

_ANSWERS = {"Save": "save", "Don't Save": "discard", "Cancel": None}


def draw(dialog: Dialog) -> list[Intent]:
    assert isinstance(dialog, Unsaved)
    imgui.text_unformatted(f"Save the changes to {dialog.name}?")
    imgui.text_disabled("Without saving they are lost.")
    pressed = buttons(list(_ANSWERS))
    return [] if pressed is None else [Answer(_ANSWERS[pressed])]
