"""How quickly and how surely the preview finds surfaces, against marching by fixed steps and Lipschitz sphere tracing.

``python -m benchmarks.preview``: same scenes, same rays, same run; what is missed is judged by the reference in float64. Times
are of the search alone; for a software renderer in seconds of processor, which other programs at work don't disturb.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import perf_counter, process_time
from typing import NamedTuple

import moderngl
import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Region, Terms, first_hits, log_gradient, log_ratio, region
from hqmodel.field.rays import box_interval
from hqmodel.gpu import assembly, offscreen
from hqmodel.gpu.memory import SceneMemory
from hqmodel.gpu.preview import shot_of
from hqmodel.gpu.screen import Target, drawn_pixels, is_slow, shared_pass
from hqmodel.gpu.studio import tile_side, tiles
from hqmodel.gpu.tables import read
from hqmodel.gpu.tracing import TURNS, trace
from hqmodel.model import Camera, Scene, Shape, Strip, Transform

from .shapes import shapes

Array = NDArray[np.float64]
_RIVALS = Path(__file__).parent / "shaders" / "rivals.frag"
# Rays that the reference is asked about; fewer where it walks many shapes.
_JUDGED = 8_000
# Shares of the region: rays that stay in the body for less only graze it, and a hit further off is another surface.
_GRAZING, _OFF = 1e-4, 1e-2


class View(NamedTuple):
    """A scene as one picture sees it."""

    scene: Scene
    terms: Terms
    where: Region
    camera: Camera
    size: tuple[int, int]
    memory: SceneMemory
    uniforms: dict[str, object]


def scattered(count: int) -> Scene:
    """So many turned boxes and balls of one size, each in a cell of its own of a cube: they touch, but never many at once."""
    rng = np.random.default_rng(count)
    side = int(np.ceil(count ** (1 / 3) - 1e-9))
    places = np.stack(np.meshgrid(*[np.arange(side)] * 3), axis=-1).reshape(-1, 3)[rng.permutation(side**3)[:count]]
    axes = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    made = []
    for place in places - (side - 1) / 2 + rng.uniform(-0.2, 0.2, size=places.shape):
        gamma, turn, scale = float(rng.choice([2.0, 4.0, 8.0])), rng.normal(size=4), rng.uniform(0.3, 0.55, size=3)
        x, y, z, w = (float(part) for part in turn / np.linalg.norm(turn))
        transform = Transform(translation=tuple(place), rotation=(x, y, z, w), scale=tuple(scale))
        strips = tuple(Strip(normal=axis, gamma=gamma) for axis in axes)
        made.append(Shape(strips=strips, hardness=6.0, transform=transform))
    return Scene(shapes=tuple(made))


def view_of(ctx: moderngl.Context, scene: Scene, size: tuple[int, int], in_cube: bool = False) -> View:
    """The scene framed from the standard view; `in_cube` as a program has it that knows no closer bounds than a cube about it."""
    terms = Terms.of(scene)
    where = region(scene, terms)
    camera = Camera().framing(where.low, where.high, size[0] / size[1])
    if in_cube:
        middle, half = (where.low + where.high) / 2, float(np.max(where.size)) / 2
        where = replace(where, low=middle - half, high=middle + half)
    memory = SceneMemory(ctx)
    memory.write(scene, terms, where)
    uniforms = {**shot_of(camera, size, "normals", None, where, memory, 0.0).uniforms, "picture_size": size, "jitter": (0.5, 0.5)}
    return View(scene, terms, where, camera, size, memory, uniforms)


def ours(ctx: moderngl.Context, view: View) -> tuple[float, Array]:
    """Seconds, and the states of march.glsl for all pixels, (height, width, 4)."""
    side = tile_side(view.memory.rows, is_slow(ctx))
    states = Target(ctx, (side, side)), Target(ctx, (side, side))
    whole = np.empty((view.size[1], view.size[0], 4))

    def draw(keep: bool) -> None:
        for left, bottom, width, height in tiles(view.size, side):
            uniforms = {**view.uniforms, "tile_origin": (left, bottom)}
            done, _ = trace(ctx, "camera", view.memory, states, (0, 0, width, height), uniforms, {})
            if keep:
                whole[bottom : bottom + height, left : left + width] = read(done.texture).reshape(side, side, 4)[:height, :width]

    draw(True)
    return timed(ctx, lambda: draw(False)), whole


def looks(ctx: moderngl.Context, view: View) -> tuple[float, int]:
    """The mean and the largest number of looks that rays take: those still searching are counted after each."""
    done, spare = Target(ctx, view.size), Target(ctx, view.size)
    tracing = shared_pass(ctx, "trace.frag", ("CAMERA_RAYS", *view.memory.defines))
    pending: list[int] = []
    while not pending or pending[-1]:
        taken = len(pending)
        uniforms = {**view.uniforms, "tile_origin": (0, 0), "fresh": int(taken == 0), "steps": int(taken > 0)}
        tracing.draw(spare, spare.whole, uniforms, {"state": done.texture}, view.memory)
        done, spare = spare, done
        pending.append(drawn_pixels(ctx, "pending.frag", spare, spare.whole, done.texture))
    return sum(pending) / max(pending[0], 1), len(pending) - 1


def rival(ctx: moderngl.Context, view: View, define: str, count: int) -> tuple[float, Array]:
    """Seconds, and states as `ours`, by at most `count` steps."""
    states = [Target(ctx, view.size) for _ in range(2)]
    rows = len(view.terms) + len(view.terms.inner)
    at_once = max(1, min(count, TURNS // (2 * rows)))
    searching = shared_pass(
        ctx, "rivals.frag", (define, *(name for name in view.memory.defines if name in ("GROUPS", "HYPERBOLIC")))
    )
    uniforms = {**view.uniforms, "tile_origin": (0, 0), "all_steps": count, **near_linear_uniforms(view)}

    def draw() -> None:
        for begin in range(0, count, at_once):
            values = {**uniforms, "begin": begin, "steps": min(at_once, count - begin)}
            searching.draw(states[1], states[1].whole, values, {"state": states[0].texture}, view.memory)
            states.reverse()

    draw()
    ctx.finish()
    result = read(states[0].texture).reshape(view.size[1], view.size[0], 4)
    return timed(ctx, draw, 1), result


def near_linear_uniforms(view: View) -> dict[str, float]:
    """The near-linear field, and its steepest slope among many points outside: sphere tracing's constant, in its favour."""
    points = np.random.default_rng(0).uniform(view.where.low, view.where.high, size=(20_000, 3))
    ratio, slope = log_gradient(view.terms, points)
    power, scale = float(1 / np.max(view.terms.outer)), float(1 / np.max(view.terms.hardness))
    with np.errstate(over="ignore"):
        slopes = power * scale * np.maximum(1 - ratio * scale, 1e-30) ** (power - 1) * np.linalg.norm(slope, axis=1)
    steepest = float(np.max(slopes[np.isfinite(slopes) & (ratio < 0)])) * view.memory.frame.scale
    return {"slowest": 1 / steepest, "power": power, "scale": scale}


def timed(ctx: moderngl.Context, draw: Callable[[], None], rounds: int = 3) -> float:
    """The least seconds of some rounds."""
    clock = process_time if is_slow(ctx) else perf_counter
    best = np.inf
    for _ in range(rounds):
        ctx.finish()
        started = clock()
        draw()
        ctx.finish()
        best = min(best, clock() - started)
    return float(best)


class Judge:
    """The reference's answer for some of a view's pixels."""

    def __init__(self, view: View) -> None:
        rng = np.random.default_rng(1)
        count = max(400, min(_JUDGED, _JUDGED * 12 // len(view.terms.inner)))
        self._pixels = rng.integers(0, view.size, size=(count, 2))
        origins, directions = view.camera.rays(self._pixels + 0.5, view.size)
        self._distance = first_hits(view.terms, view.where, origins, directions)
        extent = float(np.max(view.where.size))
        self._apart = _OFF * extent
        way = np.nan_to_num(self._distance)[:, None] + _GRAZING * extent * np.linspace(0.05, 1, 12)
        self._counts = np.isfinite(self._distance)
        self._counts &= np.all(log_ratio(view.terms, origins[:, None] + way[..., None] * directions[:, None]) > 0, axis=1)
        self._rays = origins, directions

    def missed(self, states: Array, view: View) -> tuple[int, int]:
        """Rays that pass by the body or end at another surface by a view's `states`, and how many were judged that meet it."""
        width_first = states[states.shape[0] - 1 - self._pixels[:, 1], self._pixels[:, 0]]
        t, _, far, phase = width_first.T
        hit = (phase > 0) & (phase < 4)
        enter = box_interval(view.where.low, view.where.high, *self._rays)[0]
        distance = enter + np.where(phase == 1.0, far, t) * view.memory.frame.scale
        wrong = ~hit | (np.abs(distance - self._distance) > self._apart)
        return int(np.count_nonzero(wrong & self._counts)), int(np.count_nonzero(self._counts))


def report(ctx: moderngl.Context, name: str, scene: Scene, size: tuple[int, int]) -> None:
    """One scene's lines."""
    view = view_of(ctx, scene, size)
    judge = Judge(view)
    seconds, states = ours(ctx, view)
    mean, most = looks(ctx, view)
    missed, judged = judge.missed(states, view)
    print(f"{name}, {size[0]} x {size[1]}, {judged} rays judged", flush=True)
    print(
        f"  segment bounds     {1e3 * seconds:9.1f} ms          {missed:5d} missed   looks a ray: mean {mean:.1f}, most {most}",
        flush=True,
    )
    wide = view_of(ctx, scene, size, in_cube=True)
    rivals = (
        ("64 steps", view, "FIXED", 64),
        ("256 steps", view, "FIXED", 256),
        ("256 in a cube", wide, "FIXED", 256),
        ("sphere tracing", view, "LIPSCHITZ", 256),
    )
    for label, begun, define, count in rivals:
        theirs, found = rival(ctx, begun, define, count)
        missed, _ = judge.missed(found, begun)
        print(f"  {label:18s} {1e3 * theirs:9.1f} ms {theirs / seconds:6.1f} x {missed:5d} missed", flush=True)
    for seen in (view, wide):
        seen.memory.release()


def main() -> None:
    """Print all scenes."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--size", type=int, nargs=2, default=(640, 480), metavar=("W", "H"))
    parser.add_argument("--counts", type=int, nargs="*", default=(1, 8, 16, 64, 256), help="numbers of scattered shapes")
    wanted = parser.parse_args()
    assembly.GENERATED["rivals.frag"] = partial(_RIVALS.read_text, encoding="utf-8")
    ctx = offscreen()
    print(ctx.info["GL_RENDERER"])
    width, height = wanted.size
    for name, scene in shapes().items():
        report(ctx, name, scene, (width, height))
    for count in wanted.counts:
        small = 1 if count < 8 else 4  # the rivals would take minutes
        report(ctx, f"{count} scattered", scattered(count), (width // small, height // small))
    times = {count: ours(ctx, view_of(ctx, scattered(count), (width, height)))[0] for count in wanted.counts}
    print(f"segment bounds, scattered, {width} x {height}:", ", ".join(f"{n} shapes {1e3 * s:.0f} ms" for n, s in times.items()))


if __name__ == "__main__":
    main()
