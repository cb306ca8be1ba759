"""The timeline: the scene's animations, to play and to scrub, and the numbers that each leads from one value to another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from hqmodel import edit
from hqmodel.edit.animation import Animation, Sweep
from hqmodel.edit.sweeping import remove_sweep, turntable
from hqmodel.model import Scene

from ..intents import Do, Edit, Grab, Intent, Pick, Play, Put, Stop
from ..session import Session
from .status import ERROR

_REPEATS = {"once": "Once", "loop": "Loop", "ping-pong": "To and fro"}
_EASINGS = {"linear": "Even", "smooth": "Smooth"}
_SECONDS = 0.1, 3600.0
_TABLE = imgui.TableFlags_.sizing_fixed_fit | imgui.TableFlags_.row_bg


@dataclass
class Reel:
    """What the panel remembers: the animations of the scene as it stood last, and which of them it plays."""

    scene: Scene | None = None
    animations: Sequence[Animation | str] = ()
    playing: int | None = None

    def read(self, scene: Scene) -> None:
        """Each animation, or what is wrong with it."""
        if scene is not self.scene:
            self.scene, self.animations = scene, [_read(scene, index) for index in range(len(scene.animations))]


def _read(scene: Scene, index: int) -> Animation | str:
    try:
        return edit.animation_at(scene, index)
    except edit.EditError as error:
        return str(error)


def draw(session: Session, reel: Reel) -> list[Intent]:
    """What there is to do on top, the animations in rows, and below them the numbers of the one that is picked."""
    reel.read(session.scene)
    intents = _followed(session, reel)
    picked = session.animation
    if picked is not None and not picked < len(reel.animations):
        picked = None
    intents += _tools(session, reel, picked)
    if not reel.animations:
        imgui.text_wrapped("Nothing moves yet. A right click on a slider, then Animate..., sets its number in motion.")
    elif imgui.begin_child("animations", window_flags=imgui.WindowFlags_.horizontal_scrollbar):
        if imgui.begin_table("rows", 6, _TABLE):
            imgui.table_setup_column("play")
            imgui.table_setup_column("name", imgui.TableColumnFlags_.width_stretch)
            for index, animation in enumerate(reel.animations):
                imgui.table_next_row()
                imgui.push_id(index)
                intents += _fault(index, animation) if isinstance(animation, str) else _row(session, reel, index, animation)
                imgui.pop_id()
            imgui.end_table()
        chosen = reel.animations[picked] if picked is not None else None
        if picked is not None and isinstance(chosen, Animation):
            intents += _sweeps(session.scene, picked, chosen)
        imgui.end_child()
    else:
        imgui.end_child()
    return intents


def _followed(session: Session, reel: Reel) -> list[Intent]:
    """What plays is played on as it is now, should it have been edited meanwhile."""
    player, playing = session.player, reel.playing
    if player.animation is None or playing is None:
        reel.playing = None
        return []
    now = reel.animations[playing] if playing < len(reel.animations) else ""
    if isinstance(now, str):
        reel.playing = None
        return [Stop()]
    return [] if now == player.animation else [Play(now, player.share, player.running)]


def _tools(session: Session, reel: Reel, picked: int | None) -> list[Intent]:
    """Stop, a slider through the round, the turntable, and the way out as a film."""
    intents: list[Intent] = []
    player = session.player
    imgui.begin_disabled(player.animation is None)
    if imgui.button(f"{icons.ICON_FA_STOP}###stop"):
        intents.append(Stop())
    imgui.end_disabled()
    imgui.set_item_tooltip("Stop, and put everything back")
    imgui.same_line()
    label, export = "Turntable", "Export..."
    imgui.set_next_item_width(-_wide(label) - _wide(export))
    shown = reel.animations[picked] if picked is not None else ""
    imgui.begin_disabled(isinstance(shown, str))
    share = player.share if player.animation is not None and reel.playing == picked else 0.0
    moved, share = imgui.slider_float("##scrub", 100 * share, 0.0, 100.0, "%.0f %%", imgui.SliderFlags_.always_clamp)
    imgui.end_disabled()
    if moved and isinstance(shown, Animation):
        reel.playing = picked
        intents.append(Play(shown, share / 100, running=False))
    imgui.same_line()
    if imgui.button(label):
        change = partial(turntable, camera=session.view.camera)
        intents += [Edit(label, change), Pick(len(reel.animations))]
    imgui.set_item_tooltip("Add an animation in which the camera goes once around")
    imgui.same_line()
    imgui.begin_disabled(session.job is not None)
    if imgui.button(export):
        intents.append(Do("film"))
    imgui.end_disabled()
    imgui.set_item_tooltip("Write the animation as a GIF, as pictures, or as MP4")
    return intents


def _wide(label: str) -> float:
    """The width of a button, with the space before it."""
    style = imgui.get_style()
    return imgui.calc_text_size(label).x + 2 * style.frame_padding.x + style.item_spacing.x


def _row(session: Session, reel: Reel, index: int, animation: Animation) -> list[Intent]:
    """One animation: play or pause, name, seconds, what comes after the end, how it moves, away with it."""
    intents: list[Intent] = []
    player = session.player
    ours = player.animation is not None and reel.playing == index
    running = ours and player.running
    imgui.table_next_column()
    if imgui.button(f"{icons.ICON_FA_PAUSE if running else icons.ICON_FA_PLAY}###play"):
        reel.playing = index
        ended = animation.repeat == "once" and player.share >= 1
        intents += [Pick(index), Play(animation, player.share if ours and not ended else 0.0, not running)]
    imgui.table_next_column()
    imgui.internal.get_current_window().dc.curr_line_text_base_offset = 0.0  # it is as high as a frame, and no text within one
    name = animation.name or f"Animation {index + 1}"
    if imgui.selectable(f"{name}###pick", session.animation == index, size=(0, imgui.get_frame_height()))[0]:
        intents.append(Pick(index))
    intents += _settings(session.scene, index, animation)
    imgui.table_next_column()
    return intents + _removal(index)


def _settings(scene: Scene, index: int, animation: Animation) -> list[Intent]:
    """How long, how often and how evenly."""
    intents: list[Intent] = []
    em = imgui.get_font_size()
    imgui.table_next_column()
    imgui.set_next_item_width(5 * em)
    flags = imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp
    moved, seconds = imgui.drag_float("##duration", animation.duration, 0.02, *_SECONDS, "%.1f s", flags)
    intents += _grabbed(index, "duration", "Duration")
    if moved:
        intents += _put(scene, index, animation.changed(duration=round(seconds, 2)), "Duration")
    for field, options in (("repeat", _REPEATS), ("easing", _EASINGS)):
        imgui.table_next_column()
        imgui.set_next_item_width(6.5 * em)
        present = getattr(animation, field)
        if imgui.begin_combo(f"##{field}", options[present]):
            for key, label in options.items():
                if imgui.selectable(label, key == present)[0] and key != present:
                    intents += _put(scene, index, animation.changed(**{field: key}), field.capitalize())
            imgui.end_combo()
    return intents


def _fault(index: int, fault: str) -> list[Intent]:
    """An animation that can't be played: why, and away with it."""
    imgui.table_next_column()
    imgui.table_next_column()
    imgui.push_style_color(imgui.Col_.text, ERROR)
    imgui.text_wrapped(fault)
    imgui.pop_style_color()
    imgui.table_set_column_index(5)
    return _removal(index)


def _removal(index: int) -> list[Intent]:
    removed = imgui.button(f"{icons.ICON_FA_TRASH_CAN}###remove")
    imgui.set_item_tooltip("Remove this animation")
    return [Edit("Remove animation", partial(edit.remove_animation, index=index)), Pick(None)] if removed else []


def _sweeps(scene: Scene, index: int, animation: Animation) -> list[Intent]:
    """Each number that the animation leads, with its values, first to last."""
    intents: list[Intent] = []
    count = len(animation.keyframes)
    imgui.separator_text(animation.name or f"Animation {index + 1}")
    if not imgui.begin_table("sweeps", count + 2, _TABLE):
        return []
    imgui.table_setup_column("Number", imgui.TableColumnFlags_.width_fixed)
    for number, sweep in enumerate(animation.sweeps):
        imgui.table_next_row()
        imgui.push_id(number)
        imgui.table_next_column()
        imgui.align_text_to_frame_padding()
        imgui.text_unformatted(sweep.path)
        for step in range(count):
            imgui.table_next_column()
            intents += _value(scene, index, animation, number, step)
        imgui.table_next_column()
        if imgui.button(f"{icons.ICON_FA_XMARK}###rest"):
            intents.append(Edit("Rest", partial(remove_sweep, index=index, sweep=number)))
        imgui.set_item_tooltip("This number rests again")
        imgui.pop_id()
    imgui.end_table()
    return intents


def _value(scene: Scene, index: int, animation: Animation, number: int, step: int) -> list[Intent]:
    """One value of one number, to be dragged or typed."""
    sweep = animation.sweeps[number]
    value = sweep.values[step]
    imgui.set_next_item_width(5.5 * imgui.get_font_size())
    speed = 0.01 * max(abs(value), 0.1)
    moved, value = imgui.drag_float(f"##{step}", value, speed, 0.0, 0.0, "%.4g")
    intents = _grabbed(index, f"{sweep.path} {step}", "Keyframe")
    if moved:
        values = tuple(round(value, 6) if other == step else old for other, old in enumerate(sweep.values))
        led: list[Sweep] = [old.changed(values=values) if other == number else old for other, old in enumerate(animation.sweeps)]
        intents += _put(scene, index, animation.changed(sweeps=tuple(led)), "Keyframe")
    return intents


def _grabbed(index: int, name: str, label: str) -> list[Intent]:
    return [Grab(("animations", index, name), label)] if imgui.is_item_activated() else []


def _put(scene: Scene, index: int, animation: Animation, label: str) -> list[Intent]:
    """The animation in its place: part of the drag under way; as an edit that says why not where it is not permitted."""
    try:
        return [Put(("animations",), edit.set_animation(scene, index, animation).animations, label)]
    except edit.EditError:
        return [Edit(label, partial(edit.set_animation, index=index, animation=animation))]
