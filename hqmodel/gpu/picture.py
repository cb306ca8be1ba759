"""A picture that grows: samples are summed tile by tile and shown at any moment as what they make so far."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil

import moderngl

from .memory import SceneMemory
from .screen import Rectangle, Target, shared_pass
from .studio import Shot, Studio, tiles

# Samples a pixel of a finished picture: with light and shadow, and without.
LIT_SAMPLES, PLAIN_SAMPLES = 64, 16
# Samples drawn at each visit to a tile.
BATCH = 4


class Picture:
    """The sums of one picture, its draft, and `shown`: 8 bits a channel, sRGB, opaque, bottom row first."""

    def __init__(self, ctx: moderngl.Context, size: tuple[int, int]) -> None:
        self.ctx, self.size = ctx, size
        self.shown = Target(ctx, size, dtype="f1")
        self._sums = Target(ctx, size, count=2)
        self._draft = Target(ctx, size, count=2, dtype="f2")
        self._coarse = 1

    def clear(self) -> None:
        """Forget the samples; the draft stays until there is a new one."""
        self._sums.framebuffer.clear()

    def draft(self, studio: Studio, memory: SceneMemory, shot: Shot, coarse: int) -> None:
        """Draw all of it at once, in pixels `coarse` times as large."""
        small = Shot(shot.mode, (ceil(self.size[0] / coarse), ceil(self.size[1] / coarse)), shot.uniforms)
        for tile in tiles(small.size, studio.side):
            studio.draw(memory, small, tile, self._draft, ())
        self._coarse = coarse

    def refined(self, studio: Studio, memory: SceneMemory, shot: Shot, samples: int) -> Iterator[None]:
        """Add the samples, a little at each turn."""
        every = tiles(self.size, studio.side)
        if self._coarse > 1:
            for tile in every:
                studio.draw(memory, shot, tile, self._sums, ())
                self.resolve(shot, tile)
                yield
        for first in range(0, samples, BATCH):
            for tile in every:
                studio.draw(memory, shot, tile, self._sums, range(first, min(first + BATCH, samples)))
                self.resolve(shot, tile)
                yield

    def resolve(self, shot: Shot, tile: Rectangle) -> None:
        """Bring `shown` up to date there."""
        share = tuple(ceil(side / self._coarse) / side for side in self.size)
        samples, guides = self._sums.textures
        inputs = {"samples": samples, "guides": guides, "draft": self._draft.texture}
        uniforms = {"lit": int(shot.lit), "draft_share": share}
        shared_pass(self.ctx, "resolve.frag").draw(self.shown, tile, uniforms, inputs)

    def release(self) -> None:
        for target in (self.shown, self._sums, self._draft):
            target.release()


def samples_of(shot: Shot) -> int:
    """How many samples a pixel make this picture a finished one."""
    return LIT_SAMPLES if shot.lit else PLAIN_SAMPLES
