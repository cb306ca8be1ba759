"""The command palette: a few letters, Enter, done."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from ..asks import Dialog, Palette
from ..catalogue import Command, found
from ..intents import Adjust, Answer, Intent

_SIZE = 34.0, 22.0
# The arrows move through the list while the text has the keyboard: the field is told to see them as its history.
_FLAGS = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.callback_history


def draw(dialog: Dialog) -> list[Intent]:
    """The text, and below it what fits, the closest first."""
    assert isinstance(dialog, Palette)
    moved = 0

    def arrows(data: imgui.InputTextCallbackData) -> int:
        nonlocal moved
        moved += {imgui.Key.up_arrow: -1, imgui.Key.down_arrow: 1}[data.event_key]
        return 0

    if imgui.is_window_appearing():
        imgui.set_keyboard_focus_here()
    width, height = (part * imgui.get_font_size() for part in _SIZE)
    imgui.set_next_item_width(width)
    entered, query = imgui.input_text_with_hint("##query", "Find a command", dialog.query, _FLAGS, arrows)
    commands = found(query, dialog.commands)
    chosen = max(0, min(dialog.chosen + moved, len(commands) - 1)) if query == dialog.query else 0
    picked = commands[chosen] if entered and commands else None
    if imgui.begin_child("commands", (width, height)):
        for row, command in enumerate(commands):
            if _row(command, row == chosen, scroll=row == chosen and chosen != dialog.chosen):
                picked = command
        if not commands:
            imgui.text_disabled("No command has these letters")
    imgui.end_child()
    if picked is not None and picked.enabled:
        return [Answer(picked.name)]
    if imgui.is_key_pressed(imgui.Key.escape):  # at once, though the text has the keyboard
        return [Answer()]
    if entered:
        imgui.set_keyboard_focus_here(-1)
    changed = replace(dialog, query=query, chosen=chosen)
    return [Adjust(changed)] if changed != dialog else []


def _row(command: Command, chosen: bool, scroll: bool) -> bool:
    """Label, the way to it through the menus, and keys; dim where it can't be done now."""
    right = imgui.get_cursor_pos_x() + imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x
    imgui.begin_disabled(not command.enabled)
    clicked, _ = imgui.selectable(f"{command.label.rstrip('.')}##{command.name}", chosen)
    if scroll:
        imgui.set_scroll_here_y()
    keys = "  ".join(command.keys)
    imgui.same_line(_SIZE[0] * imgui.get_font_size() * 0.5)
    imgui.text_disabled(command.trail)
    imgui.same_line(right - imgui.calc_text_size(keys).x)
    imgui.text_unformatted(keys)
    imgui.end_disabled()
    return bool(clicked)
