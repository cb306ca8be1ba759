"""From the hand to the camera: what dragging and the wheel do in the viewport, as pure functions.

Blender's middle button and Maya's Alt with any button work side by side; without either, the left button orbits.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from hqmodel.model import Camera

Button = Literal["left", "middle", "right"]
Motion = Literal["orbit", "pan", "zoom"]

# A drag up by so many pixels zooms like one step of the wheel.
PIXELS_PER_STEP = 12.0

_DRAGS: dict[tuple[Button, str], Motion] = {
    ("middle", ""): "orbit",
    ("middle", "shift"): "pan",
    ("middle", "ctrl"): "zoom",
    ("left", ""): "orbit",
    ("left", "shift"): "pan",
    ("left", "ctrl"): "zoom",
    ("right", ""): "pan",
    ("left", "alt"): "orbit",
    ("middle", "alt"): "pan",
    ("right", "alt"): "zoom",
}


@dataclass(frozen=True)
class Pointer:
    """What the mouse did over the viewport since the last frame, in pixels from its top left."""

    position: tuple[float, float]
    moved: tuple[float, float] = (0.0, 0.0)
    button: Button | None = None
    modifier: str = ""
    wheel: tuple[float, float] = (0.0, 0.0)


def motion(button: Button | None, modifier: str) -> Motion | None:
    """What a drag with this button and modifier ("", "shift", "ctrl" or "alt") does."""
    return None if button is None else _DRAGS.get((button, modifier))


def navigated(camera: Camera, pointer: Pointer, size: tuple[int, int]) -> Camera:
    """The camera after this; the very same one if nothing moved it. `size` is the viewport's, in pixels."""
    dx, dy = pointer.moved
    if dx or dy:
        match motion(pointer.button, pointer.modifier):
            case "orbit":
                camera = camera.orbited(dx, dy)
            case "pan":
                camera = camera.panned(dx, dy, size[1])
            case "zoom":
                camera = camera.zoomed(-dy / PIXELS_PER_STEP, (size[0] / 2, size[1] / 2), size)
    return _wheeled(camera, pointer, size)


def _wheeled(camera: Camera, pointer: Pointer, size: tuple[int, int]) -> Camera:
    """A wheel zooms to the cursor; two fingers sideways orbit, and with Shift they pan."""
    sideways, steps = pointer.wheel
    if pointer.modifier == "shift" and (sideways or steps):
        return camera.panned(sideways * PIXELS_PER_STEP, steps * PIXELS_PER_STEP, size[1])
    if steps:
        camera = camera.zoomed(steps, pointer.position, size)
    if sideways:
        camera = camera.orbited(sideways * PIXELS_PER_STEP, 0.0)
    return camera
