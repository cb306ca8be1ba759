"""How high the floor lies: under the body's lowest point, found by rays from below."""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Region

from .memory import SceneMemory
from .tables import cast

Array = NDArray[np.float64]
# Rays along each side of the patch that is looked at, and how often the patch is narrowed about the lowest hit.
_RAYS, _ROUNDS = 16, 4


def floor_height(ctx: moderngl.Context, memory: SceneMemory, where: Region) -> float:
    """z of the body's lowest point in the unit frame, near enough to stand on; the region's underside without a body."""
    middle, half = where.centre[:2], where.size[:2] / 2
    lowest = float(where.high[2])
    for _ in range(_ROUNDS):
        across, height = _looked_up(ctx, memory, where, middle, half)
        if not np.any(np.isfinite(height)):
            break
        best = np.nanargmin(height)
        if height[best] >= lowest - 1e-5 * memory.frame.scale:
            break
        lowest, middle, half = float(height[best]), across[best], half * 2.5 / _RAYS
    height_of_box = float(where.low[2])
    return float(memory.frame.local([0, 0, lowest if lowest < where.high[2] else height_of_box])[2])


def _looked_up(ctx: moderngl.Context, memory: SceneMemory, where: Region, middle: Array, half: Array) -> tuple[Array, Array]:
    """Points (n, 2) of a grid over the patch, and z of the body's underside above each, (n,), NaN beside it."""
    steps = (np.arange(_RAYS) + 0.5) / _RAYS * 2 - 1
    across = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2) * half + middle
    below = float(where.low[2] - 0.01 * np.max(where.size))
    origins = np.column_stack([across, np.full(len(across), below)])
    upwards = np.broadcast_to([0.0, 0.0, 1.0], origins.shape)
    return across, below + cast(ctx, memory, where, origins, upwards)
