"""Animations: named sweeps of a scene's numbers, and of the camera's angles, between keyframes; and the edits that keep them.

A moment of an animation is its phase: 0 at the first keyframe, 1 at the last.
"""

from __future__ import annotations

from dataclasses import replace
from math import exp, floor, isfinite, log
from typing import Annotated, Any, Literal, Self

from pydantic import Field, ValidationError, model_validator

from hqmodel.model import FIELDS, Camera, Number, Scene, Value, faults, pattern, place, shown
from hqmodel.model.scene import Coordinate, located

from .paths import EditError, Location, get, locations, parse, put

Easing = Literal["linear", "smooth"]
Repeat = Literal["once", "loop", "ping-pong"]
# Of films: frames a second unless said otherwise, and how many frames one has at most.
FPS, MOST_FRAMES = 25.0, 10_000

AZIMUTH, ELEVATION = "view.camera.azimuth", "view.camera.elevation"
# The camera is no part of the body: what sweeps it is applied to a Camera.
CAMERA = {
    AZIMUTH: Number("Azimuth", "From the front (0) to the right (90).", 0.0, -3600.0, 3600.0, unit="°"),
    ELEVATION: Number("Elevation", "From below (-90) to above (90).", 0.0, -90.0, 90.0, unit="°"),
}
# Components of what has to stay of length 1, which no single one of them can be swept in.
_BOUND = "shapes[].transform.rotation[]"


class Sweep(Value):
    """One number, or every number that the path means, led through keyframes that are evenly spaced.

    Without a scale the field's own is meant: logarithmic where its slider is.
    """

    path: str = ""
    values: tuple[Coordinate, ...]
    scale: Literal["linear", "log"] | None = None

    @model_validator(mode="after")
    def _moves(self) -> Self:
        if len(self.values) < 2:
            raise located(("values",), "at least two values", self.values)
        return self

    def at(self, phase: float) -> float:
        """The value at a phase; a keyframe's own value exactly."""
        between = min(floor(phase * (len(self.values) - 1)), len(self.values) - 2)
        share = phase * (len(self.values) - 1) - between
        a, b = self.values[between : between + 2]
        if share in (0, 1) or a == b:
            return b if share == 1 else a
        return exp(log(a) * (1 - share) + log(b) * share) if self.scale == "log" else a * (1 - share) + b * share


class Animation(Value):
    """Sweeps that run together. `duration` is that of one round in seconds, of a ping-pong there and back."""

    name: str = ""
    duration: Annotated[float, Field(strict=True, allow_inf_nan=False)] = 4.0
    easing: Easing = "smooth"
    repeat: Repeat = "loop"
    sweeps: tuple[Sweep, ...]

    @model_validator(mode="after")
    def _together(self) -> Self:
        if not 0 < self.duration <= 3600:
            raise located(("duration",), "a number above 0 and up to 3600", self.duration)
        if not self.sweeps:
            raise located(("sweeps",), "at least one sweep", [])
        for index, sweep in enumerate(self.sweeps):
            if len(sweep.values) != len(self.sweeps[0].values):
                expected = f"{len(self.sweeps[0].values)} values like the first sweep"
                raise located(("sweeps", index, "values"), expected, len(sweep.values))
        return self

    @property
    def keyframes(self) -> tuple[float, ...]:
        """The phases of the keyframes."""
        count = len(self.sweeps[0].values)
        return tuple(index / (count - 1) for index in range(count))

    def phase(self, share: float) -> float:
        """The phase when a share of one round, from 0 to 1, has passed; eased."""
        return self._eased(min(2 * share, 2 - 2 * share) if self.repeat == "ping-pong" else share)

    def phases(self, frames: int) -> list[float]:
        """The phases of so many evenly spaced frames of one round, eased.

        A loop that ends as it began, and a ping-pong, leave out the last frame, which the next round's first will be.
        """
        closed = self.repeat == "ping-pong" or (self.repeat == "loop" and all(map(_is_closed, self.sweeps)))
        steps = max(frames if closed else frames - 1, 1)
        shares = [index / steps for index in range(frames)]
        if self.repeat == "ping-pong":
            shares = [min(2 * index, 2 * (steps - index)) / steps for index in range(frames)]
        return [self._eased(share) for share in shares]

    def plain(self) -> dict[str, Any]:
        """As a preset keeps it; unknown keys come along."""
        tree = self.model_dump(mode="json")
        for sweep in tree["sweeps"]:
            if sweep["scale"] is None:
                del sweep["scale"]
        return tree

    def _eased(self, share: float) -> float:
        """From the share of the time to the phase: a smooth one rests at every keyframe."""
        if self.easing == "linear":
            return share
        between = len(self.sweeps[0].values) - 1
        start = min(floor(share * between), between - 1)
        s = share * between - start
        return (start + s * s * (3 - 2 * s)) / between


def animations(scene: Scene) -> tuple[Animation, ...]:
    """What the preset's `animations` say; EditError, `animations[0].sweeps[1].values[2]: expected what, got what`."""
    return tuple(animation_at(scene, index) for index in range(len(scene.animations)))


def animation_at(scene: Scene, index: int) -> Animation:
    """One of the scene's animations; EditError when it is at fault or not there."""
    tree = get(scene, ("animations", index))
    try:
        return checked(scene, Animation.model_validate(tree))
    except ValidationError as error:
        raise EditError(f"animations[{index}].{faults(error)[0]}") from None
    except EditError as error:
        raise EditError(f"animations[{index}].{error}") from None


def sweep_of(scene: Scene, text: str) -> Sweep:
    """The sweep that ``PATH=A:B[:C...]`` describes, checked against the scene; EditError with one line."""
    path, equals, values = text.partition("=")
    try:
        numbers = tuple(float(part) for part in values.split(":"))
    except ValueError:
        numbers = ()
    if not equals or not path.strip() or len(numbers) < 2 or not all(map(isfinite, numbers)):
        raise EditError(f"expected PATH=A:B or more values, such as gamma=1:60, got {shown(text)}")
    return _scaled(scene, Sweep(path=path.strip(), values=numbers), ())


def checked(scene: Scene, animation: Animation) -> Animation:
    """The animation with each sweep's scale decided; EditError where a path or a value is none of the scene's."""
    sweeps = [_scaled(scene, sweep, ("sweeps", index)) for index, sweep in enumerate(animation.sweeps)]
    return animation.changed(sweeps=tuple(sweeps))


def staged(scene: Scene, animation: Animation, phase: float) -> Scene:
    """The scene at a phase; EditError where the values together make no valid scene."""
    for sweep in animation.sweeps:
        if sweep.path not in CAMERA:
            scene = put(scene, sweep.path, sweep.at(phase))
    return scene


def filmed(camera: Camera, animation: Animation, phase: float) -> Camera:
    """The camera at a phase."""
    angles = {sweep.path.rpartition(".")[2]: sweep.at(phase) for sweep in animation.sweeps if sweep.path in CAMERA}
    return replace(camera, azimuth=angles.get("azimuth", camera.azimuth), elevation=angles.get("elevation", camera.elevation))


def add_animation(scene: Scene, animation: Animation) -> Scene:
    """The scene with one more animation, its last."""
    return _keeping(scene, [*scene.animations, checked(scene, animation).plain()])


def set_animation(scene: Scene, index: int, animation: Animation) -> Scene:
    """The scene with another animation in that place."""
    get(scene, ("animations", index))
    kept = list(scene.animations)
    kept[index] = checked(scene, animation).plain()
    return _keeping(scene, kept)


def remove_animation(scene: Scene, index: int) -> Scene:
    """The scene without that animation."""
    get(scene, ("animations", index))
    return _keeping(scene, [*scene.animations[:index], *scene.animations[index + 1 :]])


def _keeping(scene: Scene, kept: list[dict[str, Any]]) -> Scene:
    return put(scene, "animations", kept)


def _is_closed(sweep: Sweep) -> bool:
    turn = sweep.values[-1] - sweep.values[0]
    return turn == 0 or (sweep.path == AZIMUTH and turn % 360 == 0)


def _scaled(scene: Scene, sweep: Sweep, where: Location) -> Sweep:
    """The sweep with its scale, every value of it permitted at every place that the path means."""
    try:
        numbers = _numbers(scene, sweep.path)
    except EditError as error:
        raise EditError(f"{place((*where, 'path'))}: {error}" if where else str(error)) from None
    scale = sweep.scale or ("log" if all(n.logarithmic for n in numbers) and min(sweep.values) > 0 else "linear")
    for index, value in enumerate(sweep.values):
        refused = next((number for number in numbers if not number.permits(value)), None)
        if refused is not None or (scale == "log" and value <= 0):
            expected = refused.expected() if refused else "a number above 0, as its scale is log"
            raise EditError(f"{place((*where, 'values', index))}: expected {expected}, got {value:g}")
    return sweep.changed(scale=scale)


def _numbers(scene: Scene, path: str) -> list[Number]:
    """What is known of each number that the path means; EditError where it is something else."""
    if path in CAMERA:
        return [CAMERA[path]]
    found = {pattern(location) for location in locations(scene, parse(path))}
    if not all(key in FIELDS and key != _BOUND for key in found):
        raise EditError(f"expected the path of a number that can change little by little, got {shown(path)}")
    return [FIELDS[key] for key in found]
