"""The hand: from the mouse over the viewport to intents."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

from imgui_bundle import imgui

from hqmodel.gpu import Legend, Seen
from hqmodel.model import Scene

from ..intents import Choose, Intent, Look, Pull, Release, Select, Take
from ..navigation import Button, Pointer, navigated
from ..session import Session
from ..theme import enlarged
from ..tools import reach
from ..tools.aim import Aim, Pixels
from ..tools.gesture import Gesture, Held
from ..tools.grip import Grip, grip_at
from ..tools.handles import Handles, handles
from ..tools.kit import TOUCHING
from ..tools.sculpting import Soften
from ..view import View
from .gizmo import Gizmo
from .keys import keyed

# A press that moves no further than this, in pixels, is a click.
STILL = 4.0
# What a notch of the wheel is worth of a pull.
NOTCH = 9.0
_BUTTONS: dict[Button, imgui.MouseButton_] = {
    "left": imgui.MouseButton_.left,
    "middle": imgui.MouseButton_.middle,
    "right": imgui.MouseButton_.right,
}


class Picture(Protocol):
    """What is to be seen in so many pixels."""

    def draw(self, size: tuple[int, int]) -> int:
        """Bring it up to date; its texture's name."""

    def seen(self, size: tuple[int, int], pixel: tuple[int, int]) -> Seen | None:
        """What a pixel, from the top left, shows; None beside the body."""

    @property
    def legend(self) -> Legend:
        """What the colours of the curvature mode mean."""


@dataclass
class Hand:
    """What is remembered from frame to frame: the button that is held, what it was pressed on, and what is under the pointer.

    `wheeling`: what is held is turned by the wheel, and let go with the Ctrl key. `lit`: the shape and the strip that would be
    taken hold of.
    """

    button: Button | None = None
    pressed: Pixels = (0.0, 0.0)
    at: Pixels = (0.0, 0.0)
    moved: bool = False
    taking: Gesture | None = None
    boxing: bool = False
    wheeling: bool = False
    under: Seen | None = None
    lit: tuple[int, int] | None = None
    gizmo: Gizmo = field(default_factory=Gizmo)
    _looked: tuple[Scene, View, tuple[int, int]] | None = None

    @property
    def point(self) -> tuple[float, float, float] | None:
        """The point of the surface under the pointer."""
        return None if self.under is None else self.under.point

    def grip(self, scene: Scene) -> Grip | None:
        """The plane under the pointer; none on the filled cut of a section view."""
        seen = self.under
        if seen is None or (seen.shape is None and scene.dimension == 3):
            return None
        return grip_at(scene, seen.point, seen.shape, seen.strip)

    def look(self, session: Session, picture: Picture, pixel: tuple[int, int]) -> None:
        """Find out what is under the pointer, unless nothing has changed since."""
        scene, view = session.scene, session.view
        if self._looked is None or self._looked[0] is not scene or self._looked[1:] != (view, pixel):
            self._looked, self.under = (scene, view, pixel), picture.seen(session.size, pixel)


def free(session: Session, hand: Hand, picture: Picture, aim: Aim, corner: imgui.ImVec2) -> list[Intent]:
    """What the hand does while it holds nothing; the viewport is the last item, with its corner there."""
    io = imgui.get_io()
    hand.at = io.mouse_pos.x - corner.x, io.mouse_pos.y - corner.y
    if wanted := session.wanted_gesture:
        session.wanted_gesture = ""
        gesture = reach.modal(wanted, session.scene, session.selection, aim, hand.at)
        return [Take(gesture), Pull(keyed(Held(gesture)))] if gesture else []
    if hand.button is None:
        if imgui.is_item_hovered():
            scale = io.display_framebuffer_scale
            hand.look(session, picture, (int(hand.at[0] * scale.x), int(hand.at[1] * scale.y)))
        else:
            hand.under = None
    if io.key_ctrl and io.mouse_wheel and imgui.is_item_hovered() and (grip := hand.grip(session.scene)):
        hand.wheeling = True
        gesture = Soften(session.scene, aim, grip.shape, grip.strip)
        return [Take(gesture), Pull(Held(gesture, (io.mouse_wheel * NOTCH, 0.0)))]
    intents = _pressed(session, hand, aim)
    if any(isinstance(intent, Take) for intent in intents):
        return intents
    moved = navigated(session.view.camera, _pointer(hand), aim.size)
    if moved is not session.view.camera:
        intents.append(Look(moved))
    return intents


def known_handles(session: Session, aim: Aim) -> Handles | None:
    """The handles that are shown: those of the selected strip, with the tool for faces in hand."""
    shape, strip, image = session.selection.active, session.selection.strip, session.selection.image
    if session.kit.tool != "faces" or shape is None or strip is None:
        return None
    return handles(session.scene, shape, strip, aim, enlarged(session.preferences.percent), image)


def _pressed(session: Session, hand: Hand, aim: Aim) -> list[Intent]:
    """Follow the button from press to release: a click selects, a drag takes hold of what was pressed."""
    if imgui.is_item_activated():
        _press(session, hand, aim)
    if hand.button is None:
        return []
    travelled = hand.at[0] - hand.pressed[0], hand.at[1] - hand.pressed[1]
    hand.moved = hand.moved or max(map(abs, travelled)) > STILL
    if not imgui.is_item_active():
        return _let_go(session, hand, aim, travelled)
    if hand.taking is None or not hand.moved:
        return []
    gesture, hand.taking = hand.taking, None
    return [Take(gesture), Pull(Held(gesture, travelled))]


def _press(session: Session, hand: Hand, aim: Aim) -> None:
    io = imgui.get_io()
    hand.button = next((name for name, number in _BUTTONS.items() if imgui.is_mouse_down(number)), None)
    hand.pressed, hand.moved, hand.taking, hand.boxing = hand.at, False, None, False
    if hand.button == "left" and not (io.key_alt or io.key_ctrl or io.key_shift):
        scene, grip = session.scene, hand.grip(session.scene)
        hand.boxing = session.kit.tool == "box"
        hand.taking = reach.taken(session.kit, scene, session.selection, aim, hand.at, grip, known_handles(session, aim))


def _let_go(session: Session, hand: Hand, aim: Aim, travelled: Pixels) -> list[Intent]:
    io = imgui.get_io()
    button, boxing, moved, taking = hand.button, hand.boxing, hand.moved, hand.taking
    hand.button, hand.boxing, hand.taking = None, False, None
    add = io.key_ctrl or io.key_shift
    if taking is not None and moved:  # all of the drag in one slow frame
        return [Take(taking), Pull(Held(taking, travelled)), Release()]
    if boxing and moved:
        return [Choose(reach.boxed(session.scene, aim, hand.pressed, hand.at), add)]
    if button != "left" or moved:
        return []
    grip = hand.grip(session.scene)
    if grip is None:
        return [Select(None, add=add)]
    return [Select(grip.shape, grip.strip if session.kit.tool in TOUCHING else None, add, grip.image)]


def _pointer(hand: Hand) -> Pointer:
    """What the mouse did since the last frame, as far as it is the camera's."""
    io = imgui.get_io()
    wheel = (io.mouse_wheel_h, io.mouse_wheel) if imgui.is_item_hovered() else (0.0, 0.0)
    ours = hand.button is not None and hand.moved and hand.taking is None and not hand.boxing
    moved = (io.mouse_delta.x, io.mouse_delta.y) if ours else (0.0, 0.0)
    modifier = "alt" if io.key_alt else "ctrl" if io.key_ctrl else "shift" if io.key_shift else ""
    return Pointer(hand.at, moved, hand.button, modifier, wheel)
