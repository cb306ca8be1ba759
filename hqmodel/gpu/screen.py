"""Drawing over a rectangle of a target: a program, its inputs, and where the result goes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import moderngl

from .assembly import program
from .memory import SceneMemory, assign

# Texture units from here on hold a pass's own inputs; the scene's rows have the one before.
FIRST_UNIT = 1
_SOFTWARE = ("llvmpipe", "softpipe", "swrast", "swiftshader", "software", "gdi generic")
Rectangle = tuple[int, int, int, int]


class Target:
    """Textures of one size, RGBA, that are drawn into together."""

    def __init__(self, ctx: moderngl.Context, size: tuple[int, int], count: int = 1, dtype: str = "f4") -> None:
        self.size = size
        self.textures = [ctx.texture(size, 4, dtype=dtype) for _ in range(count)]
        for texture in self.textures:
            texture.repeat_x = texture.repeat_y = False
        self.framebuffer = ctx.framebuffer(self.textures)

    @property
    def texture(self) -> moderngl.Texture:
        """The first, or only, one."""
        return self.textures[0]

    @property
    def whole(self) -> Rectangle:
        return (0, 0, *self.size)

    def release(self) -> None:
        """Not to be called while it is bound."""
        self.framebuffer.release()
        for texture in self.textures:
            texture.release()


class Pass:
    """A fragment shader that runs over a rectangle of a target."""

    def __init__(self, ctx: moderngl.Context, fragment: str, defines: tuple[str, ...] = ()) -> None:
        self.ctx = ctx
        self.program = program(ctx, fragment, defines)
        self._triangle = ctx.vertex_array(self.program, [])

    def draw(
        self,
        target: Target,
        rectangle: Rectangle,
        uniforms: Mapping[str, Any],
        inputs: Mapping[str, moderngl.Texture],
        memory: SceneMemory | None = None,
        adding: bool = False,
    ) -> None:
        """Run over rectangle (left, bottom, width, height); inputs by their sampler's name; `adding` to what is there."""
        target.framebuffer.use()
        target.framebuffer.viewport = rectangle
        self.ctx.enable_only(moderngl.BLEND if adding else moderngl.NOTHING)
        self.ctx.blend_func = moderngl.ONE, moderngl.ONE
        if memory is not None:
            memory.use(self.program)
        assign(self.program, uniforms)
        for unit, (name, texture) in enumerate(inputs.items(), FIRST_UNIT):
            if name in self.program:
                texture.use(unit)
                self.program[name] = unit
        self._triangle.render(moderngl.TRIANGLES, vertices=3)


class _Shared:
    """What is made once a context and kept as long as that."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.passes: dict[tuple[str, tuple[str, ...]], Pass] = {}
        self.query = ctx.query(samples=True)  # moderngl never gives one back
        renderer = str(ctx.info["GL_RENDERER"]).lower()
        self.slow = any(name in renderer for name in _SOFTWARE)


def _shared(ctx: moderngl.Context) -> _Shared:
    if not isinstance(ctx.extra, _Shared):
        ctx.extra = _Shared(ctx)
    return ctx.extra


def shared_pass(ctx: moderngl.Context, fragment: str, defines: tuple[str, ...] = ()) -> Pass:
    """The pass, made at its first use in this context."""
    passes = _shared(ctx).passes
    if (fragment, defines) not in passes:
        passes[fragment, defines] = Pass(ctx, fragment, defines)
    return passes[fragment, defines]


def is_slow(ctx: moderngl.Context) -> bool:
    """Whether the processor does the drawing, not a graphics card."""
    return _shared(ctx).slow


def drawn_pixels(ctx: moderngl.Context, fragment: str, target: Target, rectangle: Rectangle, state: moderngl.Texture) -> int:
    """How many pixels the pass over `state` draws, and does not discard."""
    query = _shared(ctx).query
    with query:
        shared_pass(ctx, fragment).draw(target, rectangle, {}, {"state": state})
    return int(query.samples)
