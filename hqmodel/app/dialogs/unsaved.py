"""Asked before work would be lost: one's own by leaving, or another's by saving over it."""

from __future__ import annotations

from collections.abc import Mapping

from imgui_bundle import imgui

from ..asks import Dialog, Overwrite, Unsaved
from ..intents import Answer, Intent
from .buttons import buttons

_ANSWERS = {"Save": "save", "Don't Save": "discard", "Cancel": None}
_OVERWRITE_ANSWERS = {"Save As...": "elsewhere", "Overwrite": "overwrite", "Cancel": None}


def draw(dialog: Dialog) -> list[Intent]:
    assert isinstance(dialog, Unsaved)
    return _asked(f"Save the changes to {dialog.name}?", "Without saving they are lost.", _ANSWERS)


def draw_overwrite(dialog: Dialog) -> list[Intent]:
    assert isinstance(dialog, Overwrite)
    question = f"{dialog.path.name} was changed by another program since it was opened here."
    return _asked(question, "Overwriting replaces that; it is kept among the earlier versions.", _OVERWRITE_ANSWERS)


def _asked(question: str, consequence: str, answers: Mapping[str, str | None]) -> list[Intent]:
    """Two lines and a button for each answer."""
    imgui.text_unformatted(question)
    imgui.text_disabled(consequence)
    pressed = buttons(list(answers))
    return [] if pressed is None else [Answer(answers[pressed])]
