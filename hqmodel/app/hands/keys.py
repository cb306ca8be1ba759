"""What keys do to a gesture that is held."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from ..tools.arranging import Arrange
from ..tools.gesture import Held

_DIGITS = "0123456789.-"
_LETTERS = {"x": imgui.Key.x, "y": imgui.Key.y, "z": imgui.Key.z}


def keyed(held: Held) -> Held:
    """Numbers typed; Tab for the other way of doing it; x, y and z for the axes."""
    typed = held.typed + "".join(c for c in map(chr, imgui.get_io().input_queue_characters) if c in _DIGITS)
    if imgui.is_key_pressed(imgui.Key.backspace):
        typed = typed[:-1]
    gesture = held.gesture
    if imgui.is_key_pressed(imgui.Key.tab):
        gesture = gesture.other()
    if isinstance(gesture, Arrange):
        for axis, key in _LETTERS.items():
            if imgui.is_key_pressed(key, False):
                gesture = gesture.locked(axis)
    return replace(held, gesture=gesture, typed=typed)
