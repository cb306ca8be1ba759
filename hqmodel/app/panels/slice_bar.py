"""The slice t along the bottom: it slides the shape through its further dimension, by hand or by itself."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from hqmodel.edit.animation import Animation, Repeat
from hqmodel.model import FIELDS

from ..form import Form, Memory
from ..intents import Grab, Intent, Play, Stop
from ..session import Session
from ..slices import Range, SliceRange, share_at, sliding

_NOTE = "no strip has a slice rate yet: nothing moves"
_SECONDS = 0.5, 60.0


@dataclass
class Slider:
    """What the bar remembers: the range of t, how long it takes to pass through it, and how it goes on then."""

    spans: SliceRange = field(default_factory=SliceRange)
    seconds: float = 4.0
    repeat: Repeat = "ping-pong"
    _playing: Animation | None = None

    def at(self, session: Session) -> float | None:
        """How far its own round has come, None while it is not the one that plays."""
        player = session.player
        return player.share if player.animation is not None and player.animation is self._playing else None

    def play(self, span: Range, share: float, running: bool) -> Play:
        self._playing = sliding(span, self.seconds, self.repeat)
        return Play(self._playing, share, running)


def draw(session: Session, memory: Memory, slider: Slider) -> list[Intent]:
    """Buttons, one slider across the window and the seconds; dimmed where no strip moves with the slice."""
    form, spec = Form(session.shown, memory), FIELDS["slice"]
    still = not any(strip.slice for shape in session.scene.shapes for strip in shape.strips)
    span = spec.slider if still or session.history.dragging else slider.spans.of(session.scene, session.wake)
    imgui.align_text_to_frame_padding()
    imgui.text_unformatted(spec.label)
    imgui.same_line()
    imgui.begin_disabled(still)
    intents = _buttons(session, slider, span)
    imgui.end_disabled()
    if still:
        imgui.push_style_var(imgui.StyleVar_.alpha, imgui.get_style().alpha * 0.6)
    right = imgui.calc_text_size(_NOTE).x if still else 4.5 * imgui.get_font_size()
    form.slider(("slice",), replace(spec, slider=span), spec.label, width=-right - 2 * imgui.get_style().item_spacing.x)
    imgui.same_line()
    if still:
        imgui.text_unformatted(_NOTE)
        imgui.pop_style_var()
    else:
        intents += _seconds(session, slider, span)
    grabbed = any(isinstance(intent, Grab) for intent in form.intents)
    return [*intents, *([Stop()] if grabbed else []), *form.intents]


def _buttons(session: Session, slider: Slider, span: Range) -> list[Intent]:
    """Play or pause, stop, and how it goes on at the end."""
    intents: list[Intent] = []
    at, player = slider.at(session), session.player
    running = at is not None and player.running
    if imgui.button(f"{icons.ICON_FA_PAUSE if running else icons.ICON_FA_PLAY}###play"):
        start = share_at(session.scene.slice, span, slider.repeat) if at is None else at
        intents.append(slider.play(span, start, not running))
    imgui.set_item_tooltip("Pause" if running else "Let the slice slide through the shape; the scene itself does not change")
    imgui.same_line()
    imgui.begin_disabled(player.animation is None)
    if imgui.button(f"{icons.ICON_FA_STOP}###stop"):
        intents.append(Stop())
    imgui.end_disabled()
    imgui.set_item_tooltip("Stop, and put the slice back")
    imgui.same_line()
    if imgui.button(f"{icons.ICON_FA_REPEAT if slider.repeat == 'loop' else icons.ICON_FA_RIGHT_LEFT}###repeat"):
        slider.repeat = "ping-pong" if slider.repeat == "loop" else "loop"
        if at is not None:
            intents.append(slider.play(span, share_at(session.shown.slice, span, slider.repeat), running))
    imgui.set_item_tooltip("Begin again at the end" if slider.repeat == "loop" else "To and fro")
    imgui.same_line()
    return intents


def _seconds(session: Session, slider: Slider, span: Range) -> list[Intent]:
    """How long it takes from one end to the other."""
    imgui.set_next_item_width(-1)
    flags = imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp
    changed, slider.seconds = imgui.drag_float("##seconds", slider.seconds, 0.02, *_SECONDS, "%.1f s", flags)
    imgui.set_item_tooltip("Seconds from one end to the other")
    at = slider.at(session)
    return [slider.play(span, at, session.player.running)] if changed and at is not None else []
