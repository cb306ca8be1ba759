"""What the mouse and the keys do while the hand holds something: pull, type a number, lock an axis, let go, put back."""

from __future__ import annotations

from imgui_bundle import imgui

from ..intents import Drop, Intent, Pull, Release
from ..tools.gesture import Held
from .hand import NOTCH, Hand
from .keys import keyed

# What a pull counts while Shift is held.
FINE = 0.1


def holding(hand: Hand, held: Held) -> list[Intent]:
    """What becomes of what is held in this frame."""
    if imgui.is_key_pressed(imgui.Key.escape) or imgui.is_mouse_clicked(imgui.MouseButton_.right):
        _forget(hand)
        return [Drop()]
    pulled = keyed(_pulled(hand, held))
    if _finished(hand):
        _forget(hand)
        return [Pull(pulled), Release()] if pulled != held else [Release()]
    return [Pull(pulled)] if pulled != held else []


def _pulled(hand: Hand, held: Held) -> Held:
    """Followed by the mouse, or by the wheel when that is what it is held with."""
    io = imgui.get_io()
    fine = FINE if io.key_shift else 1.0
    moved = (io.mouse_wheel * NOTCH, 0.0) if hand.wheeling else (io.mouse_delta.x * fine, io.mouse_delta.y * fine)
    return held.pulled(moved, snap=io.key_ctrl and not hand.wheeling)


def _finished(hand: Hand) -> bool:
    """Let go: the button that took it, the key that the wheel needs, or a click or Enter where neither did."""
    if imgui.is_key_pressed(imgui.Key.enter) or imgui.is_key_pressed(imgui.Key.keypad_enter):
        return True
    if hand.wheeling:
        return not imgui.get_io().key_ctrl
    if hand.button is not None:
        return not imgui.is_mouse_down(imgui.MouseButton_.left)
    return imgui.is_mouse_clicked(imgui.MouseButton_.left)


def _forget(hand: Hand) -> None:
    hand.button, hand.taking, hand.wheeling = None, None, False
