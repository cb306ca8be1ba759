"""Finding one's way in the real window. Each function is one visit, in a process of its own."""

from __future__ import annotations

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from hqmodel import files
from hqmodel.app.asks import Palette, Shortcuts, Tour
from hqmodel.app.dialogs.tour import STEPS

from .drive import Hands
from .scenarios import CTRL, Key

ICONS = {
    icons.ICON_FA_COPY: "duplicate",
    icons.ICON_FA_TRASH_CAN: "delete",
    icons.ICON_FA_ARROW_UP: "move up",
    icons.ICON_FA_ARROW_DOWN: "move down",
}


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


def the_tour(hands: Hands) -> None:
    """Five steps, forth and back, each about a window that is there; it can be skipped, and is not shown again by itself."""
    session = hands.session
    hands.menu("View/Panels/###panel Presets")
    hands.menu("Help/###tour")
    for number, step in enumerate(STEPS):
        assert session.dialogs == [Tour(number)]
        hands.settle(3)
        assert any(window.name.startswith(step.window) and window.was_active for window in imgui.get_current_context().windows)
        hands.shoot(f"tour-{number + 1}")
        if number == 1:
            hands.click("//Welcome to hqmodel/Back")
            assert session.dialogs == [Tour(0)]
            hands.keys(Key.enter)
        hands.click(f"//Welcome to hqmodel/{'Start' if number == len(STEPS) - 1 else 'Next'}")
    assert not session.dialogs
    assert files.Settings.read().preferences["toured"] is True
    hands.menu("Help/###tour")
    hands.click("//Welcome to hqmodel/Skip")
    assert not session.dialogs


def everything_larger(hands: Hands) -> None:
    """The size is applied at once and kept; no button of the outliner leaves its panel at any."""
    before = imgui.get_font_size()
    for percent in (200, 80):
        hands.menu(f"View/Size/###size {percent}")
        hands.settle(4)
        assert abs(imgui.get_font_size() / before - percent / 100) < 0.02
        assert files.Settings.read().preferences["percent"] == percent
        panel = hands.ctx.get_window_by_ref("//Outliner")
        for button in ("###add", *(f"{icon}##{name}" for icon, name in ICONS.items()), "shape 0/###eye"):
            rect = hands.ctx.item_info(f"//Outliner/**/{button}").rect_full
            hands.check(button)
            assert panel.pos.x <= rect.min.x
            assert rect.max.x <= panel.pos.x + panel.size.x, button
        hands.shoot(f"size-{percent}")
