"""A finished picture without a window."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import ceil

import moderngl
import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Plane, Region, Terms, region
from hqmodel.model import Camera, Scene, usual

from .context import framebuffer_kept, must_be_sound, offscreen
from .floor import floor_height
from .memory import SceneMemory
from .picture import BATCH, Picture
from .preview import shot_of
from .screen import is_slow
from .studio import Shot, Studio, tile_side, tiles

# Samples a pixel.
SAMPLES = 16
# The largest part of a picture that is held on the GPU at once, in pixels along a side.
_PART = 1024


def render(
    scene: Scene,
    camera: Camera | None = None,
    size: tuple[int, int] = (1024, 768),
    mode: str = "clay",
    cut: Plane | None = None,
    samples: int = SAMPLES,
    ctx: moderngl.Context | None = None,
    progress: Callable[[float, str], None] | None = None,
    where: Region | None = None,
) -> NDArray[np.uint8]:
    """The scene as the preview shows it, (height, width, 4) of sRGB, opaque, top row first.

    Without a camera the body is framed from its usual side. What lies in front of the plane `cut` is left out, and the cut is
    shown filled. `progress` is told the share done (0..1) and what is being done; whatever it raises ends the work. `where` is
    the scene's region, for those who have it. Raises GpuError without OpenGL, or where it fails,
    ValueError for a mode that is none of `MODES`.
    """
    own = offscreen() if ctx is None else ctx
    terms = Terms.of(scene)
    where = region(scene, terms) if where is None else where
    if camera is None:
        camera = usual(scene.dimension).framing(where.low, where.high, size[0] / size[1])
    memory = SceneMemory(own)
    memory.write(scene, terms, where)
    shot = shot_of(camera, size, mode, cut, where, memory, floor_height(own, memory, where))
    pixels = _drawn(own, memory, shot, samples, progress or (lambda share, doing: None))
    memory.release()
    if ctx is None:
        own.release()
    return pixels


def _drawn(
    ctx: moderngl.Context, memory: SceneMemory, shot: Shot, samples: int, tell: Callable[[float, str], None]
) -> NDArray[np.uint8]:
    """All of the shot, part by part."""
    result = np.empty((shot.size[1], shot.size[0], 4), dtype=np.uint8)
    studio = Studio(ctx, tile_side(memory.rows, is_slow(ctx)))
    parts = tiles(shot.size, _PART)
    for number, (left, bottom, width, height) in enumerate(parts):
        picture = Picture(ctx, (width, height))
        part = replace(shot, origin=(left, bottom))
        with framebuffer_kept(ctx):
            steps = ceil(samples / BATCH) * len(tiles((width, height), studio.side))
            for step, _ in enumerate(picture.refined(studio, memory, part, samples)):
                ctx.finish()
                tell((number + min(1.0, (step + 1) / steps)) / len(parts), "Drawing")
            drawn = np.frombuffer(picture.shown.read(), dtype=np.uint8)
        result[bottom : bottom + height, left : left + width] = drawn.reshape(height, width, 4)
        picture.release()
    studio.release()
    must_be_sound(ctx)
    return result[::-1].copy()
