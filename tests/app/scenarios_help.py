"""Finding one's way in the real window. Each function is one visit, in a process of its own."""

from __future__ import annotations

from imgui_bundle import imgui

from hqmodel.app.asks import Palette, Shortcuts

from .drive import Hands
from .scenarios import CTRL, Key


def the_command_palette(hands: Hands) -> None:
    """Ctrl+P, a few letters, Enter; arrows choose, Esc closes, what can't be done now is not done."""
    session = hands.session

    def opened() -> Palette:
        hands.keys(CTRL | Key.p)
        hands.settle(3)
        dialog = session.dialogs[-1]
        assert isinstance(dialog, Palette)
        return dialog

    opened()
    hands.ctx.key_chars("adbl")
    hands.settle()
    hands.shoot("palette")
    hands.keys(Key.enter)
    assert not session.dialogs
    assert session.history.labels == ["Add block"]
    opened()
    hands.ctx.key_chars("view ")
    hands.keys(Key.down_arrow)
    hands.keys(Key.down_arrow)
    hands.keys(Key.up_arrow)
    dialog = session.dialogs[-1]
    assert isinstance(dialog, Palette)
    assert (dialog.query, dialog.chosen) == ("view ", 1)
    hands.keys(Key.escape)
    assert not session.dialogs
    opened()
    hands.ctx.key_chars("redo")
    hands.keys(Key.enter)
    assert session.dialogs, "there is nothing to be done again"
    hands.keys(Key.escape)
    opened()
    hands.click("//Commands/**/Duplicate##duplicate")
    assert session.history.labels == ["Add block", "Duplicate"]


def the_sheet_of_shortcuts(hands: Hands) -> None:
    """All of it can be seen, in the smallest window by scrolling."""
    hands.keys(Key.f1)
    assert isinstance(hands.session.dialogs[-1], Shortcuts)
    hands.settle(3)
    window = hands.ctx.get_window_by_ref("//Shortcuts")
    size, view = window.size, imgui.get_main_viewport().work_size
    assert size.x <= view.x
    assert size.y <= view.y
    hands.shoot("shortcuts")
    hands.keys(Key.escape)
    assert not hands.session.dialogs
