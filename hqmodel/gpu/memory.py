"""A scene in GPU memory: its texture and the uniforms that go with it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import moderngl

from hqmodel.field import Region, Terms
from hqmodel.model import Scene

from .cells import cells
from .packing import Frame, pack

SCENE_UNIT = 0


class SceneMemory:
    """One scene's rows on the GPU. `rows`: the most of them that one look at a point or a segment walks."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        self._texture: moderngl.Texture | None = None

    def write(self, scene: Scene, terms: Terms, region: Region, frame: Frame | None = None) -> None:
        """Replace what is there, in the region's own unit frame unless told another.

        The texture is made anew only when it has to grow or shrink.
        """
        self.frame = Frame.of(region) if frame is None else frame
        packed = pack(scene, terms, self.frame)
        low, high = self.frame.local(region.low), self.frame.local(region.high)
        grid = cells(packed, low, high) if "CELLS" in packed.defines else None
        texels = packed.texels() if grid is None else packed.texels(grid.texels(packed.length))
        size = texels.shape[1], texels.shape[0]
        if self._texture is None or self._texture.size != size:
            self.release()
            self._texture = self.ctx.texture(size, 4, dtype="f4")
        self._texture.write(texels.tobytes())
        self.defines = packed.defines
        self.rows = len(packed.terms) + len(packed.strips) if grid is None else grid.rows
        self.uniforms: dict[str, Any] = {
            **packed.uniforms,
            **({} if grid is None else grid.uniforms(packed.length)),
            "region_low": tuple(low),
            "region_high": tuple(high),
            "region_cut": int(region.cut),
            "cut": (0.0, 0.0, 0.0, 1.0),
            "scene_memory": SCENE_UNIT,
        }

    def use(self, program: moderngl.Program) -> None:
        """Bind the rows for this program."""
        assert self._texture is not None
        self._texture.use(SCENE_UNIT)
        assign(program, self.uniforms)

    def release(self) -> None:
        if self._texture is not None:
            self._texture.release()
            self._texture = None


def assign(program: moderngl.Program, values: Mapping[str, Any]) -> None:
    """Set those uniforms that the program has: a compiler drops the ones that it does not need."""
    for name, value in values.items():
        if name in program:
            program[name] = value
