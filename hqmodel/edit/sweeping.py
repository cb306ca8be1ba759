"""Numbers set in motion and put to rest: sweeps added to a scene's animations, and taken out of them."""

from __future__ import annotations

from math import log

from hqmodel.model import FIELDS, Camera, Number, Scene, pattern, place

from .animation import AZIMUTH, Animation, Sweep, add_animation, animation_at, remove_animation, set_animation
from .paths import EditError, Location, get


def animate(scene: Scene, location: Location, index: int | None = None, name: str = "") -> Scene:
    """The scene with one more number swept: from what it is to the far end of its slider, in the animation of that index
    or, without one, in a new one of that name. EditError where it is swept there already or is none that can be.
    """
    path, spec = place(location), FIELDS.get(pattern(location))
    if spec is None:
        raise EditError(f"{path}: expected a number that can change little by little")
    if index is None:
        return add_animation(scene, Animation(name=name, repeat="ping-pong", sweeps=(_leading(scene, location, spec, 2),)))
    animation = animation_at(scene, index)
    if any(sweep.path == path for sweep in animation.sweeps):
        raise EditError(f"animations[{index}]: expected a number that is not animated there yet, got {path}")
    sweep = _leading(scene, location, spec, len(animation.keyframes))
    return set_animation(scene, index, animation.changed(sweeps=(*animation.sweeps, sweep)))


def turntable(scene: Scene, camera: Camera) -> Scene:
    """The scene with one more animation, in which the camera goes once around it."""
    sweep = Sweep(path=AZIMUTH, values=(camera.azimuth, camera.azimuth + 360.0), scale="linear")
    return add_animation(scene, Animation(name="turntable", duration=8.0, easing="linear", sweeps=(sweep,)))


def remove_sweep(scene: Scene, index: int, sweep: int) -> Scene:
    """The scene with one number of that animation at rest again; with its last one the animation goes."""
    animation = animation_at(scene, index)
    rest = tuple(other for number, other in enumerate(animation.sweeps) if number != sweep)
    return set_animation(scene, index, animation.changed(sweeps=rest)) if rest else remove_animation(scene, index)


def _leading(scene: Scene, location: Location, spec: Number, count: int) -> Sweep:
    """The sweep with so many keyframes from the present value to the far end of the slider."""
    value = float(get(scene, location))
    scale = "log" if spec.logarithmic and value > 0 else "linear"
    line = Sweep(path=place(location), values=(value, _far_end(spec, value)), scale=scale)
    return line.changed(values=tuple(line.at(step / (count - 1)) for step in range(count)))


def _far_end(spec: Number, value: float) -> float:
    """The end of the slider's range that is farther away, as the slider shows it."""
    low, high = spec.slider
    if spec.logarithmic and value > 0:
        return high if log(high) - log(value) >= log(value) - log(low) else low
    return high if high - value >= value - low else low
