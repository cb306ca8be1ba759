"""What went wrong, line by line."""

from __future__ import annotations

from imgui_bundle import imgui

from ..asks import Dialog, Problem
from ..intents import Answer, Intent
from .buttons import buttons

_WIDTH = 36.0
_LINES = 14


def draw(dialog: Dialog) -> list[Intent]:
    """The lines can be copied: they may be wanted elsewhere."""
    assert isinstance(dialog, Problem)
    width = _WIDTH * imgui.get_font_size()
    needed = sum(imgui.calc_text_size(line, wrap_width=width).y + imgui.get_style().item_spacing.y for line in dialog.lines)
    height = min(needed, _LINES * imgui.get_text_line_height_with_spacing())
    scrollbar = imgui.get_style().scrollbar_size
    if imgui.begin_child("lines", (width + scrollbar, height)):
        imgui.push_text_wrap_pos(width)
        for line in dialog.lines:
            imgui.text_unformatted(line)
        imgui.pop_text_wrap_pos()
    imgui.end_child()
    pressed = buttons(["OK", "Copy"])
    if pressed == "Copy":
        imgui.set_clipboard_text("\n".join(dialog.lines))
    return [Answer()] if pressed == "OK" else []
