"""The viewport: the body's picture, the hand that turns it, and a click that selects."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import Protocol

from imgui_bundle import imgui

from ..intents import Intent, Look, Resize, Select
from ..navigation import Button, Pointer, navigated
from ..session import Session

# A press that moves no further than this, in pixels, is a click.
STILL = 4.0
_BUTTONS: dict[Button, imgui.MouseButton_] = {
    "left": imgui.MouseButton_.left,
    "middle": imgui.MouseButton_.middle,
    "right": imgui.MouseButton_.right,
}
_ANY = imgui.ButtonFlags_.mouse_button_left | imgui.ButtonFlags_.mouse_button_middle | imgui.ButtonFlags_.mouse_button_right


@dataclass
class Hand:
    """What the viewport remembers of the button that is held: which, and how far it has travelled."""

    button: Button | None = None
    travelled: float = 0.0


class Picture(Protocol):
    """What is to be seen in so many pixels."""

    def draw(self, size: tuple[int, int]) -> int:
        """Bring it up to date; its texture's name."""

    def shape_at(self, size: tuple[int, int], pixel: tuple[int, int]) -> int | None:
        """The shape that a pixel shows."""


def draw(session: Session, hand: Hand, picture: Picture) -> list[Intent]:
    """The picture, in as many pixels as there is room for."""
    room, scale = imgui.get_content_region_avail(), imgui.get_io().display_framebuffer_scale
    points = max(1, int(room.x)), max(1, int(room.y))
    size = max(1, round(points[0] * scale.x)), max(1, round(points[1] * scale.y))
    corner = imgui.get_cursor_screen_pos()
    imgui.image(imgui.ImTextureRef(picture.draw(size)), points, (0, 1), (1, 0))
    imgui.set_cursor_screen_pos(corner)
    imgui.invisible_button("view", points, _ANY | imgui.ButtonFlags_.allow_overlap)
    imgui.set_item_key_owner(imgui.Key.mouse_wheel_y)
    imgui.set_item_key_owner(imgui.Key.mouse_wheel_x)
    intents: list[Intent] = [] if size == session.size else [Resize(size)]
    intents += _clicked(session, hand, corner, picture)
    moved = navigated(session.view.camera, _pointer(hand, corner), points)
    if moved is not session.view.camera:
        intents.append(Look(moved))
    _caption(session, corner)
    return intents


def _pointer(hand: Hand, corner: imgui.ImVec2) -> Pointer:
    """What the mouse did since the last frame, as far as it is ours."""
    io = imgui.get_io()
    position = io.mouse_pos.x - corner.x, io.mouse_pos.y - corner.y
    wheel = (io.mouse_wheel_h, io.mouse_wheel) if imgui.is_item_hovered() else (0.0, 0.0)
    held = hand.button is not None and hand.travelled > STILL
    moved = (io.mouse_delta.x, io.mouse_delta.y) if held else (0.0, 0.0)
    modifier = "alt" if io.key_alt else "ctrl" if io.key_ctrl else "shift" if io.key_shift else ""
    return Pointer(position, moved, hand.button, modifier, wheel)


def _clicked(session: Session, hand: Hand, corner: imgui.ImVec2, picture: Picture) -> list[Intent]:
    """Follow the button that is down; the shape under a click that went nowhere is selected."""
    io = imgui.get_io()
    if imgui.is_item_activated():
        hand.button = next((name for name, number in _BUTTONS.items() if imgui.is_mouse_down(number)), None)
        hand.travelled = 0.0
    if hand.button is None:
        return []
    hand.travelled += hypot(io.mouse_delta.x, io.mouse_delta.y)
    if imgui.is_item_active():
        return []
    button, hand.button = hand.button, None
    if button != "left" or hand.travelled > STILL:
        return []
    scale = io.display_framebuffer_scale
    pixel = int((io.mouse_pos.x - corner.x) * scale.x), int((io.mouse_pos.y - corner.y) * scale.y)
    return [Select(picture.shape_at(session.size, pixel), add=io.key_ctrl or io.key_shift)]


def _caption(session: Session, corner: imgui.ImVec2) -> None:
    """What is shown, in the corner."""
    view = session.view
    text = f"{view.mode.capitalize()}   {'Orthographic' if view.camera.orthographic else 'Perspective'}"
    inset = imgui.get_font_size() * 0.6
    for shift, color in ((1.0, (0.0, 0.0, 0.0, 0.6)), (0.0, (1.0, 1.0, 1.0, 0.85))):
        at = corner.x + inset + shift, corner.y + inset + shift
        imgui.get_window_draw_list().add_text(at, imgui.get_color_u32(color), text)
