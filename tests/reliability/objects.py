"""OpenGL objects, counted: of all names that were ever given, those that still stand for something."""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import moderngl

from hqmodel import files
from hqmodel.gpu import Preview
from hqmodel.model import usual


class Alive(NamedTuple):
    """How many objects there are of each kind."""

    textures: int
    buffers: int
    framebuffers: int


def alive(ctx: moderngl.Context) -> Alive:
    """The objects of the context that is current."""
    texture, buffer = ctx.texture((1, 1), 4), ctx.buffer(reserve=4)
    framebuffer = ctx.framebuffer([texture])
    newest = (texture.glo, buffer.glo, framebuffer.glo)
    for made in (framebuffer, buffer, texture):
        made.release()
    opengl = ctypes.CDLL("libOpenGL.so.0")
    known = (opengl.glIsTexture, opengl.glIsBuffer, opengl.glIsFramebuffer)
    return Alive(*(sum(is_one(name) & 1 for name in range(1, last + 1)) for is_one, last in zip(known, newest, strict=True)))


def alive_after(ctx: moderngl.Context, scenes: int) -> list[Alive]:
    """The objects after each of four quarters of so many scenes, drawn one after the other in one preview at changing sizes."""
    preview, seen = Preview(ctx), []
    presets = [files.load(preset.path) for preset in files.builtin()[:6]]
    for number in range(1, scenes + 1):
        preview.show(presets[number % len(presets)])
        camera = usual(preview.scene.dimension).framing(preview.region.low, preview.region.high, 1.5)
        preview.draw(camera, (48 + 8 * (number % 3), 32), quick=True)
        if number % (scenes // 4) == 0:
            seen.append(alive(ctx))
    preview.release()
    return seen
