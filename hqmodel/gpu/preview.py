"""The preview: a scene drawn into a texture of its own, better with every call until nothing is left to refine."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import sqrt
from time import perf_counter
from typing import NamedTuple

import moderngl
import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Plane, Region, Terms, region
from hqmodel.model import Camera, Scene

from .context import framebuffer_kept
from .floor import floor_height
from .legend import Legend
from .memory import SceneMemory
from .modes import MATERIALS, MODES
from .picture import Picture, Rows
from .screen import is_slow
from .shells import around, carving
from .sight import camera_uniforms, cut_uniform, depth_range, light_uniforms
from .studio import Shot, Studio, tile_side

# Seconds that a draft should take: the next one's pixels are made coarser or finer for that.
_DRAFT_SECONDS = 0.035
_COARSEST = 8
# Samples a pixel of a finished picture: with light and shadow on a graphics card, and otherwise.
_LIT_SAMPLES, _SAMPLES = 64, 16


class Seen(NamedTuple):
    """What lies under a pixel: the world point, its distance from the eye, and the shape and strip that it belongs to."""

    point: tuple[float, float, float]
    distance: float
    shape: int | None
    strip: int | None


class Preview:
    """Draws into `texture` (RGBA, sRGB, opaque, bottom row first); show it with `texture.glo`, which changes with the size.

    Whatever framebuffer was bound before a call is bound after it.
    """

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        self._slow = is_slow(ctx)
        self._memory, self._carving = SceneMemory(ctx), SceneMemory(ctx)
        self._carved: Scene | None = None  # the scene whose carving shapes are in memory
        self._studio: Studio | None = None
        self._picture = Picture(ctx, (16, 16))
        self._coarse = 2 if self._slow else 1
        self._shot: Shot | None = None
        self._work: Iterator[None] = iter(())
        self._left = True
        self.show(Scene(shapes=()))

    @property
    def texture(self) -> moderngl.Texture:
        """The picture as it stands."""
        return self._picture.shown

    def show(self, scene: Scene, quick: bool = False) -> None:
        """From now on draw this scene; `quick`ly, in a region that may be larger than need be, while something is dragged."""
        self._terms = Terms.of(scene)
        self.scene, self.region = scene, region(scene, self._terms, loosely=quick)
        self._memory.write(scene, self._terms, self.region)
        self._floor = floor_height(self.ctx, self._memory, self.region)
        self._shot = None
        if self._slow:
            self._coarse = max(self._coarse, min(self._memory.rows // 64, _COARSEST))

    def draw(
        self,
        camera: Camera,
        size: tuple[int, int],
        mode: str = "clay",
        quick: bool = False,
        budget: float = 0.03,
        cut: Plane | None = None,
        lit_strip: tuple[int, int] | None = None,
        ghosts: bool = False,
    ) -> bool:
        """Bring the picture of that size (width, height) nearer to finished, for about `budget` seconds.

        What lies in front of the plane `cut` is left out, and the cut shown filled. What `lit_strip` (shape, strip) shapes is
        tinted, which starts nothing again. With `ghosts` the shapes that carve are shown as faint shells.

        True while a further call with the same arguments, but not `quick`, would refine it. `quick` is for while something is
        being dragged: a draft, the coarser the slower the machine. Raises ValueError for a mode that is none of `MODES`.
        """
        started = perf_counter()
        with framebuffer_kept(self.ctx):
            shot = replace(self._shot_of(camera, size, mode, cut), ghosts=self._ghosts() if ghosts else None)
            if shot != self._shot:
                self._begin(shot)
            self._picture.light(self._rows_of(lit_strip))
            if not quick:
                self._refine(started + budget)
        return self._left

    def legend(self) -> Legend:
        """What the colours of the curvature mode mean in this scene."""
        return Legend.of(self.region)

    def pixels(self) -> NDArray[np.uint8]:
        """The picture as it stands, (height, width, 4), top row first."""
        width, height = self.texture.size
        return np.frombuffer(self.texture.read(), dtype=np.uint8).reshape(height, width, 4)[::-1]

    def pick(self, camera: Camera, size: tuple[int, int], pixel: tuple[int, int], cut: Plane | None = None) -> Seen | None:
        """What lies under a pixel (from the top left) of a picture of that size; None beside the body.

        A point of the cut belongs to no shape and strip.
        """
        shot = self._shot_of(camera, size, MODES[0], cut)
        with framebuffer_kept(self.ctx):
            seen = self._ready_studio().seen(self._memory, shot, (pixel[0], size[1] - 1 - pixel[1]))
        x, y, z, distance, _, _, _, kind, _, _, _, row = (float(value) for value in np.frombuffer(seen, dtype=np.float32))
        if kind not in (1.0, 3.0):
            return None
        frame = self._memory.frame
        point = frame.centre + frame.scale * np.array([x, y, z])
        shape, strip = (None, None) if row < 0 else (int(index) for index in self._terms.strip_source[int(row)])
        return Seen((float(point[0]), float(point[1]), float(point[2])), distance * frame.scale, shape, strip)

    def release(self) -> None:
        """Give back what the GPU holds for this preview; it can't be used after that."""
        self._picture.release()
        self._memory.release()
        self._carving.release()
        if self._studio is not None:
            self._studio.release()

    def _shot_of(self, camera: Camera, size: tuple[int, int], mode: str, cut: Plane | None) -> Shot:
        return shot_of(camera, size, mode, cut, self.region, self._memory, self._floor)

    def _ghosts(self) -> SceneMemory | None:
        """The scene's carving shapes as bodies of their own; None without any."""
        shapes = carving(self.scene)
        if shapes is None:
            return None
        if self._carved is not self.scene:
            self._carving.write(shapes, Terms.of(shapes), around(self.region), self._memory.frame)
            self._carved = self.scene
        return self._carving

    def _rows_of(self, strip: tuple[int, int] | None) -> Rows | None:
        """The rows on the GPU of a strip, one for each of its shape's mirror images."""
        if strip is None:
            return None
        rows = np.flatnonzero(np.all(self._terms.strip_source == strip, axis=1))
        if not len(rows):
            return None
        return int(rows[0]), int(rows[1] - rows[0]) if len(rows) > 1 else 1, len(rows)

    def _begin(self, shot: Shot) -> None:
        """Another picture: a draft of it at once, and all the refining ahead."""
        if shot.size != self._picture.size:
            self._picture.release()
            self._picture = Picture(self.ctx, shot.size)
        studio = self._ready_studio()
        started = perf_counter()
        self._picture.draft(studio, self._memory, shot, self._coarse)
        self.ctx.finish()
        seconds = perf_counter() - started
        self._work = self._picture.refined(studio, self._memory, shot, self.samples(shot.mode))
        self._shot, self._left = shot, True
        wanted = self._coarse * sqrt(seconds / _DRAFT_SECONDS)
        if not 0.7 < wanted / self._coarse < 1.2:
            self._coarse = round(min(max(wanted, 1), _COARSEST))

    def _refine(self, until: float) -> None:
        while self._left:
            self._left = next(self._work, self) is None
            self.ctx.finish()
            if perf_counter() >= until:
                break

    def samples(self, mode: str) -> int:
        """How many samples a pixel a finished picture of that mode has."""
        return _LIT_SAMPLES if mode in MATERIALS and not self._slow else _SAMPLES

    def _ready_studio(self) -> Studio:
        side = tile_side(self._memory.rows, self._slow)
        if self._studio is None or self._studio.side != side:
            if self._studio is not None:
                self._studio.release()
            self._studio = Studio(self.ctx, side)
        return self._studio


def shot_of(
    camera: Camera, size: tuple[int, int], mode: str, cut: Plane | None, where: Region, memory: SceneMemory, floor: float
) -> Shot:
    """All that a picture from this camera needs to know; the floor's height in the unit frame."""
    if mode not in MODES:
        raise ValueError(f"mode: expected one of {', '.join(MODES)}, got {mode!r}")
    uniforms = {
        **camera_uniforms(camera, size, memory.frame),
        **light_uniforms(camera),
        "cut": cut_uniform(cut, memory.frame),
        "depth_range": depth_range(camera, where, memory.frame),
        "ground": int(mode in MATERIALS),
        "ground_z": floor,
        **(Legend.of(where).uniforms(memory.frame.scale) if mode == "curvature" else {}),
    }
    return Shot(mode, size, uniforms)
