"""Sending rays through a scene, in as many draws as it takes.

llvmpipe ends a shader's loops after 65,536 turns in all and says nothing; other drivers reset after seconds. So a draw gets a
number of steps that keeps well below, and the search goes on where it was in the next.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import moderngl

from .memory import SceneMemory
from .screen import Rectangle, Target, drawn_pixels, is_slow, shared_pass

# Turns of all loops that a fragment may take in one draw.
TURNS = 60_000
# Rows of the scene times pixels that a draw may walk: a fraction of a second, on the processor and on a graphics card.
_WORK_SLOW, _WORK = 2e7, 1e10
# Looks at a ray's segments after which it is given up: far more than grazing rays were seen to take.
MOST_STEPS = 3_000
KINDS = {
    "given": ("GIVEN_RAYS",),
    "camera": ("CAMERA_RAYS",),
    "key": ("KEY_RAYS", "ANY_HIT"),
    "sky": ("SKY_RAYS", "ANY_HIT"),
}


def trace(
    ctx: moderngl.Context,
    kind: str,
    memory: SceneMemory,
    states: tuple[Target, Target],
    rectangle: Rectangle,
    uniforms: Mapping[str, Any],
    inputs: Mapping[str, moderngl.Texture],
) -> tuple[Target, Target]:
    """Search along one ray of one of `KINDS` a pixel; returns the two targets, first the one that holds the result."""
    done, spare = states
    steps = _steps(memory.rows, rectangle[2] * rectangle[3], is_slow(ctx))
    tracing = shared_pass(ctx, "trace.frag", (*KINDS[kind], *memory.defines))
    for taken in range(0, MOST_STEPS, steps):
        values = {**uniforms, "fresh": int(taken == 0), "steps": steps}
        tracing.draw(spare, rectangle, values, {**inputs, "state": done.texture}, memory)
        done, spare = spare, done
        if not drawn_pixels(ctx, "pending.frag", spare, rectangle, done.texture):
            break
    return done, spare


def _steps(rows: int, pixels: int, slow: bool) -> int:
    """Steps a draw may take in a scene of so many rows (terms and strips): each walks them all, some twice."""
    work = (_WORK_SLOW if slow else _WORK) / (max(rows, 1) * pixels)
    return max(1, int(min(TURNS / (2 * max(rows, 1)), work)))
