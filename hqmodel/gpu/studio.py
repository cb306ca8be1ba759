"""One sample of one tile of a picture: what the camera sees there, what light reaches it, and the colour that makes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import moderngl

from .memory import SceneMemory
from .modes import MATERIALS, MODES
from .screen import Rectangle, Target, shared_pass
from .sight import KEY_RADIUS
from .tracing import trace

# Samples of light for each look through the camera.
_LIGHTS = 2
# Steps of the two-dimensional golden ratio (Roberts' R2 sequence): even at any count.
_STEP = (0.7548776662466927, 0.5698402909980532)


@dataclass(frozen=True)
class Shot:
    """A picture to be taken: everything about it but the scene's own rows."""

    mode: str
    size: tuple[int, int]
    uniforms: dict[str, Any] = field(repr=False)
    origin: tuple[int, int] = (0, 0)  # the pixel at the lower left of what is drawn of it
    ghosts: SceneMemory | None = field(default=None, repr=False)  # what is shown as faint shells

    @property
    def lit(self) -> bool:
        """Whether this mode shows light and shadow."""
        return self.mode in MATERIALS

    @property
    def shadowed(self) -> bool:
        """Whether the key light throws shadows in it."""
        return self.lit and self.mode != "studio"


class Studio:
    """Works on tiles of up to side x side pixels."""

    def __init__(self, ctx: moderngl.Context, side: int) -> None:
        self.ctx, self.side = ctx, side
        self._surface, self._shells = (Target(ctx, (side, side), count=3) for _ in range(2))
        self._states = [Target(ctx, (side, side)) for _ in range(4)]

    def draw(self, memory: SceneMemory, shot: Shot, tile: Rectangle, target: Target, samples: Sequence[int]) -> None:
        """Draw a tile (left, bottom, width, height) of the target, which shows the picture from shot.origin on.

        Samples after number 0 are added to what is there. No samples stand for a draft: the pixel's middle, hard shadows and
        an even sky.
        """
        here = (0, 0, *tile[2:])
        uniforms = {
            **shot.uniforms,
            "mode": MODES.index(shot.mode),
            "lit": int(shot.lit),
            "shells": int(shot.ghosts is not None),
            "picture_size": shot.size,
            "tile_origin": (tile[0] + shot.origin[0], tile[1] + shot.origin[1]),
            "target_origin": tile[:2],
            "key_radius": KEY_RADIUS if samples else 0.0,
            "sky_rays": int(bool(samples) and shot.lit),
        }
        for sample in samples or (0,):
            uniforms["sample_number"] = sample
            if sample % _LIGHTS == 0 or sample == samples[0]:
                view = sample // _LIGHTS
                uniforms["jitter"] = tuple((0.5 + view * step) % 1.0 for step in _STEP)
                self._look(memory, here, uniforms, self._surface)
                if shot.ghosts is not None:
                    self._look(shot.ghosts, here, {**uniforms, "ground": 0}, self._shells)
            inputs = self._surface_inputs()
            if shot.ghosts is not None:
                inputs["shell_position"], inputs["shell_normal"] = self._shells.textures[:2]
            if shot.shadowed:
                inputs["key_state"] = self._trace("key", 1, memory, here, uniforms)
            if uniforms["sky_rays"]:
                inputs["sky_state"] = self._trace("sky", 2, memory, here, uniforms)
            shared_pass(self.ctx, "shade.frag").draw(target, tile, uniforms, inputs, memory, adding=sample > 0)

    def _look(self, memory: SceneMemory, here: Rectangle, uniforms: dict[str, Any], surface: Target) -> None:
        """Find the surfaces that the camera sees."""
        state = self._trace("camera", 0, memory, here, uniforms)
        defines = [name for name in memory.defines if name in ("GROUPS", "HYPERBOLIC", "CELLS")]
        if uniforms["mode"] == MODES.index("curvature"):
            defines.append("CURVATURE")
        shared_pass(self.ctx, "surface.frag", tuple(defines)).draw(surface, here, uniforms, {"state": state}, memory)

    def seen(self, memory: SceneMemory, shot: Shot, pixel: tuple[int, int]) -> bytes:
        """Position, distance, normal, kind, colour and strip's row (surface.frag) at one pixel, counted from the lower left."""
        uniforms = {**shot.uniforms, "mode": MODES.index(shot.mode), "picture_size": shot.size, "tile_origin": pixel}
        uniforms["jitter"] = (0.5, 0.5)
        here = (0, 0, 1, 1)
        self._look(memory, here, uniforms, self._surface)
        framebuffer = self._surface.framebuffer
        return b"".join(framebuffer.read(here, 4, attachment, dtype="f4") for attachment in range(3))

    def _surface_inputs(self) -> dict[str, moderngl.Texture]:
        names = ("surface_position", "surface_normal", "surface_color")
        return dict(zip(names, self._surface.textures, strict=True))

    def _trace(self, kind: str, place: int, memory: SceneMemory, here: Rectangle, uniforms: dict[str, Any]) -> moderngl.Texture:
        """Trace into the state kept for that place; the last state is everyone's spare."""
        states = self._states[place], self._states[-1]
        self._states[place], self._states[-1] = trace(self.ctx, kind, memory, states, here, uniforms, self._surface_inputs())
        return self._states[place].texture

    def release(self) -> None:
        for target in (self._surface, self._shells, *self._states):
            target.release()


def tile_side(rows: int, slow: bool) -> int:
    """How large tiles are drawn at once, for a scene of so many rows, on the processor (slow) or a graphics card."""
    side = 128 if rows <= 128 else 64
    return side if slow else 8 * side


def tiles(size: tuple[int, int], side: int) -> list[Rectangle]:
    """The rectangles that a picture falls into, the middle ones first."""
    width, height = size
    every = [(x, y, min(side, width - x), min(side, height - y)) for y in range(0, height, side) for x in range(0, width, side)]
    return sorted(every, key=lambda tile: (tile[0] + tile[2] / 2 - width / 2) ** 2 + (tile[1] + tile[3] / 2 - height / 2) ** 2)
