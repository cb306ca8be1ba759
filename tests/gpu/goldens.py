"""The pictures that the golden tests compare with: ``make goldens`` draws them anew. Look at each before it is committed."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

import moderngl
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from hqmodel.field import Plane, region
from hqmodel.gpu import MODES, Legend, Preview, offscreen, render, with_legend
from hqmodel.model import Camera, Group, Scene, Shape, Strip, Transform

FOLDER = Path(__file__).parent.parent / "data" / "golden"
SIZE = (96, 72)
Pixels = NDArray[np.uint8]


def _scene() -> Scene:
    """A rounded block that runs into a ball of another colour, beside a cusped star, with a hole through the block."""
    axes = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    block = Shape(
        strips=tuple(Strip(normal=axis, gamma=12.0, half_width=width) for axis, width in zip(axes, (0.7, 0.5, 0.6), strict=True)),
        color=(0.80, 0.42, 0.24),
        hardness=2.0,
        transform=Transform(translation=(-0.5, 0.0, 0.0), rotation=(0.0, 0.0, 0.15, 0.9887)),
    )
    ball = Shape(
        strips=tuple(Strip(normal=axis) for axis in axes),
        color=(0.25, 0.52, 0.72),
        hardness=2.0,
        transform=Transform(translation=(0.45, 0.0, 0.1), scale=(0.55, 0.55, 0.55)),
    )
    star = Shape(
        strips=tuple(Strip(normal=axis, gamma=0.7) for axis in axes),
        color=(0.90, 0.82, 0.62),
        hardness=30.0,
        transform=Transform(translation=(0.9, -0.7, -0.35), scale=(0.35, 0.35, 0.35)),
    )
    hole = Shape(
        strips=(
            Strip(normal=axes[0], group="round"),
            Strip(normal=axes[2], group="round"),
            Strip(normal=axes[1], gamma=2.0, sign=-1),
        ),
        groups={"round": Group(gamma=2.0)},
        coefficient=-1.0,
        hardness=16.0,
        transform=Transform(translation=(-0.55, 0.0, 0.0), scale=(0.28, 0.9, 0.28)),
    )
    return Scene(shapes=(block, ball, star, hole), bounds=((-1.5, -1.2, -0.8), (1.4, 1.0, 1.0)))


SCENE = _scene()
BOX = region(SCENE)
CAMERA = Camera(azimuth=25.0).framing(BOX.low, BOX.high, SIZE[0] / SIZE[1], 0.95)
CUT = Plane((0.2, -1.0, 0.0), 0.1)


def _still(ctx: moderngl.Context, mode: str, cut: Plane | None = None) -> Pixels:
    return render(SCENE, CAMERA, SIZE, mode, cut, ctx=ctx)


def _previewed(ctx: moderngl.Context, lit_strip: tuple[int, int] | None = None, ghosts: bool = False) -> Pixels:
    preview = Preview(ctx)
    preview.show(SCENE)
    while preview.draw(CAMERA, SIZE, "clay", lit_strip=lit_strip, ghosts=ghosts):
        pass
    pixels = preview.pixels().copy()
    preview.release()
    return pixels


def _legend(ctx: moderngl.Context) -> Pixels:
    return with_legend(render(SCENE, CAMERA, (240, 180), "curvature", samples=2, ctx=ctx), Legend.of(BOX))


PICTURES: dict[str, Callable[[moderngl.Context], Pixels]] = {
    **{mode: partial(_still, mode=mode) for mode in MODES},
    **{f"cut-{mode}": partial(_still, mode=mode, cut=CUT) for mode in ("clay", "metal", "strips")},
    "lit-strip": partial(_previewed, lit_strip=(0, 2)),
    "ghosts": partial(_previewed, ghosts=True),
    "legend": _legend,
}


def main() -> None:
    """Draw them all anew."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    ctx = offscreen()
    for name, draw in PICTURES.items():
        Image.fromarray(draw(ctx)).convert("RGB").save(FOLDER / f"{name}.png", optimize=True)


if __name__ == "__main__":
    main()
