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
# Rows of strips: the first, from one to the next, and how many.
Rows = tuple[int, int, int]


class Picture:
    """The sums of one picture, its draft, and what they make: 8 bits a channel, sRGB, opaque, bottom row first."""

    def __init__(self, ctx: moderngl.Context, size: tuple[int, int]) -> None:
        self.ctx, self.size = ctx, size
        self._plain, self._tinted = (Target(ctx, size, dtype="f1") for _ in range(2))
        self._sums = Target(ctx, size, count=3)
        self._draft = Target(ctx, size, count=3)
        self._coarse = 1
        self._share: tuple[float, ...] | None = None  # how much of its texture the draft fills, as long as that is shown
        self._lit: Rows | None = None

    @property
    def shown(self) -> moderngl.Texture:
        """The picture as it stands."""
        return (self._plain if self._lit is None else self._tinted).texture

    def light(self, rows: Rows | None) -> None:
        """From now on tint the surface that the strip of those rows shapes."""
        if rows != self._lit:
            self._lit = rows
            self._tint(self._plain.whole)

    def draft(self, studio: Studio, memory: SceneMemory, shot: Shot, coarse: int) -> None:
        """Draw all of it at once, in pixels `coarse` times as large."""
        small = replace(shot, size=(ceil(self.size[0] / coarse), ceil(self.size[1] / coarse)))
        for tile in tiles(small.size, studio.side):
            studio.draw(memory, small, tile, self._draft, ())
        self._share = tuple(part / whole for part, whole in zip(small.size, self.size, strict=True))
        uniforms = {"lit": int(shot.lit), "draft_share": self._share}
        inputs = {"draft": self._draft.texture}
        shared_pass(self.ctx, "resolve.frag", ("DRAFT",)).draw(self._plain, self._plain.whole, uniforms, inputs)
        self._tint(self._plain.whole)
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
            self._share = None

    def _resolve(self, shot: Shot, tile: Rectangle) -> None:
        """Bring what is shown up to date there."""
        samples, guides, _ = self._sums.textures
        inputs = {"samples": samples, "guides": guides}
        shared_pass(self.ctx, "resolve.frag").draw(self._plain, tile, {"lit": int(shot.lit)}, inputs)
        self._tint(tile)

    def _tint(self, tile: Rectangle) -> None:
        if self._lit is None:
            return
        marked = self._sums if self._share is None else self._draft
        uniforms = {"lit_rows": self._lit, "marks_share": self._share or (1.0, 1.0)}
        inputs = {"shown": self._plain.texture, "marks": marked.textures[2]}
        shared_pass(self.ctx, "mark.frag").draw(self._tinted, tile, uniforms, inputs)

    def release(self) -> None:
        for target in (self._plain, self._tinted, self._sums, self._draft):
            target.release()
