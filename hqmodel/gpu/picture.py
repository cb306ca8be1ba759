"""A picture that grows: samples are summed tile by tile and shown at any moment as what they make so far."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import ceil

import moderngl

from .memory import SceneMemory
from .screen import Rectangle, Target, shared_pass
from .studio import Shot, Studio, tiles

# Samples drawn at each visit to a tile.
BATCH = 2


class Picture:
    """The sums of one picture, its draft, and `shown`: 8 bits a channel, sRGB, opaque, bottom row first."""

    def __init__(self, ctx: moderngl.Context, size: tuple[int, int]) -> None:
        self.ctx, self.size = ctx, size
        self.shown = Target(ctx, size, dtype="f1")
        self._sums = Target(ctx, size, count=2)
        self._draft = Target(ctx, size, count=2, dtype="f2")
        self._coarse = 1

    def draft(self, studio: Studio, memory: SceneMemory, shot: Shot, coarse: int) -> None:
        """Draw all of it at once, in pixels `coarse` times as large."""
        small = replace(shot, size=(ceil(self.size[0] / coarse), ceil(self.size[1] / coarse)))
        for tile in tiles(small.size, studio.side):
            studio.draw(memory, small, tile, self._draft, ())
        share = tuple(part / whole for part, whole in zip(small.size, self.size, strict=True))
        uniforms = {"lit": int(shot.lit), "draft_share": share}
        inputs = {"draft": self._draft.texture}
        shared_pass(self.ctx, "resolve.frag", ("DRAFT",)).draw(self.shown, self.shown.whole, uniforms, inputs)
        self._coarse = coarse

    def refined(self, studio: Studio, memory: SceneMemory, shot: Shot, samples: int) -> Iterator[None]:
        """Add the samples, a little at each turn."""
        self._sums.framebuffer.clear()
        every = tiles(self.size, studio.side)
        if self._coarse > 1:
            for tile in every:
                studio.draw(memory, shot, tile, self._sums, ())
                self._resolve(shot, tile)
                yield
        for first in range(0, samples, BATCH):
            for tile in every:
                studio.draw(memory, shot, tile, self._sums, range(first, min(first + BATCH, samples)))
                self._resolve(shot, tile)
                yield

    def _resolve(self, shot: Shot, tile: Rectangle) -> None:
        """Bring `shown` up to date there."""
        samples, guides = self._sums.textures
        inputs = {"samples": samples, "guides": guides}
        shared_pass(self.ctx, "resolve.frag").draw(self.shown, tile, {"lit": int(shot.lit)}, inputs)

    def release(self) -> None:
        for target in (self.shown, self._sums, self._draft):
            target.release()
