"""How what moves shall be exported as a film, and what came of it."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from hqmodel import film
from hqmodel.edit.animation import MOST_FRAMES

from ..asks import ChooseFile, Dialog, FilmAs, Filmed, FilmSettings
from ..intents import Adjust, Answer, Ask, Intent
from ..panels.status import ERROR
from .buttons import buttons
from .fields import combo, file, label

_FORMATS = {".gif": "Animated GIF", ".mp4": "MP4 video", ".png": "Numbered PNG pictures"}
_FRAMING = {False: "From where the camera is", True: "All of the body in every frame"}
_RATES, _SECONDS, _SIDES = (1, 60), (0.1, 600.0), (16, 4096)


def draw(dialog: Dialog) -> list[Intent]:
    """What moves, how large, how long, and where to."""
    assert isinstance(dialog, FilmAs)
    settings = _motion(dialog)
    suffix = settings.path.suffix.lower()
    chosen = combo("Format", suffix, _FORMATS)
    if chosen != suffix:
        settings = replace(settings, path=settings.path.with_suffix(chosen))
    path, browsing = file(settings.path)
    settings = replace(_picture(settings), path=path)
    problem = _problem(settings)
    if problem:
        imgui.text_colored(ERROR, problem)
    else:
        imgui.text_disabled(f"{settings.frames} frames")
    pressed = buttons(["Export", "Cancel"], enabled=not problem)
    changed: list[Intent] = [] if settings == dialog.settings else [Adjust(replace(dialog, settings=settings))]
    if browsing:
        return [*changed, Ask(ChooseFile("export", path.parent, path.name, (chosen,)))]
    if pressed == "Cancel":
        return [Answer()]
    return [*changed, Answer(settings)] if pressed else changed


def draw_report(dialog: Dialog) -> list[Intent]:
    """Where it is."""
    assert isinstance(dialog, Filmed)
    first, last = dialog.files[0], dialog.files[-1]
    imgui.text_unformatted(first.name if first == last else f"{first.name} to {last.name}")
    imgui.text_disabled(str(first.parent))
    imgui.spacing()
    imgui.text_unformatted(dialog.told)
    return [Answer()] if buttons(["OK"]) else []


def _motion(dialog: FilmAs) -> FilmSettings:
    """Which animation, whether the view turns, and how long that takes."""
    settings = dialog.settings
    names: dict[int | None, str] = {index: name for index, (name, _) in dialog.animations.items()}
    animation = combo("Animation", settings.animation, {**names, None: "None"})
    if animation != settings.animation:
        seconds = settings.seconds if animation is None else dialog.animations[animation][1]
        settings = replace(settings, animation=animation, seconds=seconds)
    label("Turntable")
    _, turning = imgui.checkbox("The view turns once around", settings.turning)
    label("Seconds")
    _, seconds = imgui.input_double("##seconds", settings.seconds, 0.0, 0.0, "%.4g")
    label("Frames a second")
    _, fps = imgui.slider_int("##fps", round(settings.fps), *_RATES, flags=imgui.SliderFlags_.always_clamp)
    return replace(settings, turning=turning, seconds=seconds, fps=float(fps))


def _picture(settings: FilmSettings) -> FilmSettings:
    """How large, and from how far."""
    label("Pixels")
    _, (width, height) = imgui.input_int2("##pixels", list(settings.size))
    return replace(settings, size=(width, height), whole=combo("Seen", settings.whole, _FRAMING))


def _problem(settings: FilmSettings) -> str:
    if settings.animation is None and not settings.turning:
        return "Nothing moves: choose an animation, or let the view turn"
    if not settings.path.parent.is_dir():
        return f"There is no folder {settings.path.parent}"
    if not _SECONDS[0] <= settings.seconds <= _SECONDS[1]:
        return f"The seconds must be from {_SECONDS[0]:g} to {_SECONDS[1]:g}"
    if not 2 <= settings.frames <= MOST_FRAMES:
        return f"There must be 2 to {MOST_FRAMES} frames, not {settings.frames}"
    if not all(_SIDES[0] <= side <= _SIDES[1] for side in settings.size):
        return f"Width and height must be from {_SIDES[0]} to {_SIDES[1]} pixels"
    try:
        film.check(settings.path, settings.frames, settings.seconds)
    except film.FilmError as error:
        reason = str(error).removeprefix(f"{settings.path}: ")
        return reason[0].upper() + reason[1:]
    return ""
