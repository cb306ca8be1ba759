"""The row of buttons under a dialog."""

from __future__ import annotations

from collections.abc import Sequence

from imgui_bundle import imgui

_WIDTH = 7.0


def buttons(labels: Sequence[str], enabled: bool = True) -> str | None:
    """The label that was pressed; Enter presses the first one. `enabled` is about the first one alone."""
    imgui.spacing()
    imgui.separator()
    imgui.spacing()
    pressed = None
    for index, label in enumerate(labels):
        if index:
            imgui.same_line()
        imgui.begin_disabled(index == 0 and not enabled)
        wide = max(_WIDTH * imgui.get_font_size(), imgui.calc_text_size(label).x + 2 * imgui.get_style().frame_padding.x)
        if imgui.button(label, (wide, 0)):
            pressed = label
        imgui.end_disabled()
        if index == 0:
            imgui.set_item_default_focus()
    if pressed is None and enabled and entered() and untouched():
        pressed = labels[0]
    return pressed


def entered() -> bool:
    """Whether Enter was pressed."""
    return imgui.is_key_pressed(imgui.Key.enter) or imgui.is_key_pressed(imgui.Key.keypad_enter)


def untouched() -> bool:
    """Whether no control is at work, nor has just ended with this very key."""
    context = imgui.get_current_context()
    return context.active_id == 0 and context.active_id_previous_frame == 0
