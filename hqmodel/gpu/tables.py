"""Tables of points and of rays through the preview's own shaders."""

from __future__ import annotations

from typing import NamedTuple

import moderngl
import numpy as np
from numpy.typing import ArrayLike, NDArray

from hqmodel.field import Region, Terms, region
from hqmodel.field.rays import box_interval
from hqmodel.model import Scene

from .context import framebuffer_kept, must_be_sound, offscreen
from .memory import SceneMemory
from .packing import LIMIT
from .screen import Target, shared_pass
from .tracing import trace

Array = NDArray[np.float64]
_WIDTH = 64
# Rays in one draw.
_AT_ONCE = 4096
# The phases of march.glsl.
_SEARCHING, _BRACKETED, _INSIDE, _MISS = 0.0, 1.0, 3.0, 4.0


class Values(NamedTuple):
    """The field at n points as the GPU works it out, in float32 and within 1e38; what is in world units is so."""

    value: Array  # (n,) F
    log_ratio: Array  # (n,) L
    curvature: Array  # (n,) Gaussian, of the level set through the point
    strip: NDArray[np.intp]  # (n,) the shaping strip's row in `Terms`; -1 for none
    normal: Array  # (n, 3) outwards, of length 1; 0 where there is no slope


def field_values(ctx: moderngl.Context, scene: Scene, points: ArrayLike) -> Values:
    """What the preview's shaders make of the field at points (n, 3)."""
    terms = Terms.of(scene)
    memory = SceneMemory(ctx)
    memory.write(scene, terms, region(scene, terms))
    local = np.clip(memory.frame.local(points), -LIMIT, LIMIT)
    table = _texture(ctx, local)
    target = Target(ctx, table.size, count=2)
    with framebuffer_kept(ctx):
        probe = shared_pass(ctx, "probe.frag", ("GROUPS", "HYPERBOLIC", "CURVATURE"))
        probe.draw(target, target.whole, {}, {"points": table}, memory)
        values, facing = (read(texture)[: len(local)] for texture in target.textures)
    for each in (table, target, memory):
        each.release()
    f, ratio, curvature, strip = values.T
    return Values(f, ratio, curvature / memory.frame.scale**2, strip.astype(np.intp), facing[:, :3])


def raycast(scene: Scene, origins: ArrayLike, directions: ArrayLike, ctx: moderngl.Context | None = None) -> Array:
    """Distance in world units from each origin (n, 3) along its direction (n, 3, any length) to the first entry into the body.

    (n,) values, NaN for a miss; 0 where the origin is inside. By the preview's own intersection. Raises GpuError without
    OpenGL, or where it fails.
    """
    own = offscreen() if ctx is None else ctx
    terms = Terms.of(scene)
    where = region(scene, terms)
    memory = SceneMemory(own)
    memory.write(scene, terms, where)
    result = cast(own, memory, where, origins, directions)
    memory.release()
    must_be_sound(own)
    if ctx is None:
        own.release()
    return result


def cast(ctx: moderngl.Context, memory: SceneMemory, where: Region, origins: ArrayLike, directions: ArrayLike) -> Array:
    """Like `raycast`, in a scene that is on the GPU already; the way to the region's box is gone in float64."""
    o, d = np.asarray(origins, dtype=float).reshape(-1, 3), np.asarray(directions, dtype=float).reshape(-1, 3)
    result = np.full(len(o), np.nan)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        d = d / np.max(np.abs(d), axis=1, keepdims=True)
        d = d / np.linalg.norm(d, axis=1, keepdims=True)
        enter, leave = box_interval(where.low, where.high, o, d)
    rays = np.flatnonzero(np.all(np.isfinite(o) & np.isfinite(d), axis=1) & (enter <= leave) & (not where.empty))
    for start in range(0, len(rays), _AT_ONCE):
        some = rays[start : start + _AT_ONCE]
        begin = o[some] + enter[some, None] * d[some]
        result[some] = enter[some] + _cast(ctx, memory, begin, d[some], leave[some] - enter[some])
    return result


def _cast(ctx: moderngl.Context, memory: SceneMemory, begin: Array, unit: Array, length: Array) -> Array:
    scale = memory.frame.scale
    origins = _texture(ctx, np.column_stack([memory.frame.local(begin), length / scale]))
    directions = _texture(ctx, unit)
    states = Target(ctx, origins.size), Target(ctx, origins.size)
    inputs = {"ray_origins": origins, "ray_directions": directions}
    with framebuffer_kept(ctx):
        done, _ = trace(ctx, "given", memory, states, states[0].whole, {}, inputs)
        t, _, far, phase = read(done.texture)[: len(begin)].T
    for each in (origins, directions, *states):
        each.release()
    t = np.where(phase == _BRACKETED, far, np.where(phase == _INSIDE, 0.0, t))
    return np.where((phase == _MISS) | (phase == _SEARCHING), np.nan, t) * scale


def read(texture: moderngl.Texture) -> Array:
    """The texels of a float texture, (n, 4)."""
    return np.frombuffer(texture.read(), dtype=np.float32).reshape(-1, 4).astype(float)


def _texture(ctx: moderngl.Context, rows: Array) -> moderngl.Texture:
    """Rows (n, at most 4) as the texels of a texture, in reading order."""
    lines = max(1, -(-len(rows) // _WIDTH))
    texels = np.zeros((lines * _WIDTH, 4), dtype=np.float32)
    texels[: len(rows), : rows.shape[1]] = rows
    return ctx.texture((_WIDTH, lines), 4, texels.tobytes(), dtype="f4")
