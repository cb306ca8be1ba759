"""A figure's stages, the keyframes of its first animation, each as a panel that knows how to draw itself."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import moderngl
import numpy as np
from PIL import Image

from hqmodel import gpu
from hqmodel.edit import Animation, animation_at, filmed, staged
from hqmodel.field import Region, region
from hqmodel.model import Camera, Scene, remembered
from hqmodel.outline import Outline, outline

from ..views import usual
from . import flat
from .landscape import draw_landscape, land_of
from .lettering import label
from .sheet import WIDE, Panel, Size

_MODE, _SAMPLES = "clay", 8
# Bodies of which one is smaller than this share of another are each shown as large as there is room.
_ALIKE = 0.75
# How near outlines are to the true ones, as a share of their size: less than a pixel.
_PRECISION = 1e-4


def panels(scene: Scene, ctx: moderngl.Context, bands: bool = False) -> list[list[Panel]]:
    """The rows of panels of a figure; `bands` shows how its strips bound it instead of its stages one by one."""
    animation = animation_at(scene, 0)
    stages = [staged(scene, animation, phase) for phase in animation.keyframes]
    if scene.dimension == 3:
        return [_solid(scene, animation, stages, ctx)]
    outlines = [outline(stage, precision=_PRECISION) for stage in stages]
    bounds = np.array([found.bounds for found in outlines])
    low, high = np.min(bounds[:, 0], axis=0), np.max(bounds[:, 1], axis=0)
    if bands:
        return [_banded(stages, outlines, low, high)]
    levels = [sweep for sweep in animation.sweeps if sweep.path == "level"]
    bounded = len(scene.shapes) == 1 and not levels
    aspect = WIDE if (high - low)[0] > 1.3 * (high - low)[1] else 1.0
    sections = [
        Panel(partial(flat.draw_stage, stage, found, bounded, low, high), label(animation, phase), aspect)
        for stage, found, phase in zip(stages, outlines, animation.keyframes, strict=True)
    ]
    if not levels:
        return [sections]
    land = land_of(scene, low, high)
    cut = [partial(draw_landscape, land, stage.level, found) for stage, found in zip(stages, outlines, strict=True)]
    return [[Panel(draw, (), aspect) for draw in cut], sections]


def _banded(stages: list[Scene], outlines: list[Outline], low: flat.Array, high: flat.Array) -> list[Panel]:
    """Each strip by itself, then all of them with the outlines of every stage one in another (figure 5)."""
    every = flat.strips(stages[0])
    found = list(zip(stages, outlines, strict=True))[::-1]

    def draw(chosen: list[tuple[flat.Array, float]], nested: list[tuple[Scene, Outline]], size: Size) -> Image.Image:
        window = flat.Window((low + high) / 2, float(np.max(high - low)) * 0.75, size)
        picture, pen = flat.canvas(window)
        for strip in chosen:
            flat.draw_strip(pen, window, *strip)
        for index, (stage, shape) in enumerate(nested):
            flat.draw_outline(pen, window, stage, shape, filled=index == 0)
        return flat.finished(picture)

    exponents = " … ".join(f"{stage.shapes[0].strips[0].gamma:g}" for stage in (stages[0], stages[-1]))
    last = Panel(partial(draw, every, found), [("γ", True), (f" = {exponents}", False)])
    return [*(Panel(partial(draw, [strip], []), _inequality(*strip)) for strip in every), last]


def _inequality(normal: flat.Array, offset: float) -> list[tuple[str, bool]]:
    """|x + y| ≤ 1 and its like."""
    runs = [("|", False)]
    for factor, letter in ((normal[0], "x"), (normal[1], "y"), (offset, "")):
        if factor:
            sign = ("−" if len(runs) == 1 else " − ") if factor < 0 else "" if len(runs) == 1 else " + "
            size = f"{abs(factor):g}" if abs(factor) != 1 or not letter else ""
            runs += [(sign + size, False), (letter, True)]
    return [*runs, ("| ≤ 1", False)]


def _solid(scene: Scene, animation: Animation, stages: list[Scene], ctx: moderngl.Context) -> list[Panel]:
    """Bodies of like size under one camera, others each by itself."""
    start = remembered(scene.view.get("camera")) or usual(scene.dimension)
    regions = [region(stage) for stage in stages]
    sizes = [float(np.linalg.norm(where.size)) for where in regions]
    if min(sizes) > _ALIKE * max(sizes):
        low, high = np.min([where.low for where in regions], axis=0), np.max([where.high for where in regions], axis=0)
        regions = [replace(where, low=low, high=high) for where in regions]
    cameras = [filmed(start, animation, phase) for phase in animation.keyframes]
    aspect = WIDE if all(map(_is_wide, cameras, regions)) else 1.0
    return [
        Panel(partial(_rendered, stage, camera.framing(where.low, where.high, aspect), ctx), label(animation, phase), aspect)
        for stage, camera, where, phase in zip(stages, cameras, regions, animation.keyframes, strict=True)
    ]


def _is_wide(camera: Camera, where: Region) -> bool:
    across, up, _ = np.abs(camera.axes()) @ where.size
    return bool(across > 1.3 * up)


def _rendered(stage: Scene, camera: Camera, ctx: moderngl.Context, size: Size) -> Image.Image:
    return Image.fromarray(gpu.render(stage, camera, size, _MODE, samples=_SAMPLES, ctx=ctx)).convert("RGB")
