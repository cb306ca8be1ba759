"""Shader sources put together from the files in shaders/, with errors that name the file and the line."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import moderngl

from hqmodel.resources import folder

from . import layout, modes
from .context import undisturbed

# Files that are not on disk but come from what Python knows.
GENERATED = {"layout.glsl": layout.glsl, "modes.glsl": modes.glsl}
_INCLUDE = re.compile(r'^\s*#include\s+"([\w./-]+)"\s*$')
# How Mesa, NVIDIA and Apple/Intel name a place: "3:12(7): ", "3(12) : ", "ERROR: 3:12: ".
_PLACE = re.compile(r"(?<![\w.])(\d+)(?::(\d+)(?:\(\d+\))?|\((\d+)\))\s*:")


class ShaderError(Exception):
    """A shader does not compile or an include is missing: a fault of the program, not of its input."""


@dataclass(frozen=True)
class Source:
    """A whole shader, and the files that the numbers in its #line directives stand for."""

    text: str
    files: tuple[str, ...]

    def readable(self, log: str) -> str:
        """A compiler's log with ``file:line:`` in place of its numbers."""

        def named(match: re.Match[str]) -> str:
            number, line = int(match[1]), match[2] or match[3]
            return f"{self.files[number]}:{line}:" if number < len(self.files) else match[0]

        return _PLACE.sub(named, log)


@dataclass
class _Assembler:
    lines: list[str] = field(default_factory=list)
    files: list[str] = field(default_factory=list)

    def add(self, name: str, wanted_by: str) -> None:
        if name in self.files:
            return
        number = len(self.files)
        self.files.append(name)
        if number:
            self.lines.append(f"#line 1 {number}")
        for count, line in enumerate(_text(name, wanted_by).splitlines(), 1):
            include = _INCLUDE.match(line)
            if include:
                self.add(include[1], f"{name}:{count}")
                self.lines.append(f"#line {count + 1} {number}")
            else:
                self.lines.append(line)


def assemble(name: str, defines: tuple[str, ...] = ()) -> Source:
    """The shader of that name from shaders/, each include put in once, the first time it is asked for.

    `defines` follow the #version line. Raises ShaderError when a file is missing.
    """
    assembler = _Assembler()
    assembler.add(name, "the program")
    version, *rest = assembler.lines
    head = [version, *(f"#define {define}" for define in defines), "#line 2 0"]
    return Source("\n".join([*head, *rest, ""]), tuple(assembler.files))


def program(ctx: moderngl.Context, fragment: str, defines: tuple[str, ...] = ()) -> moderngl.Program:
    """The program that runs this fragment shader over the whole viewport.

    Raises ShaderError with the compiler's words, each place as file and line.
    """
    vertex_source, source = assemble("screen.vert"), assemble(fragment, defines)
    try:
        with undisturbed():
            return ctx.program(vertex_shader=vertex_source.text, fragment_shader=source.text)
    except moderngl.Error as error:
        raise ShaderError(f"{fragment}: {source.readable(str(error))}") from error


def _text(name: str, wanted_by: str) -> str:
    if name in GENERATED:
        return GENERATED[name]()
    try:
        return (folder("shaders") / name).read_text(encoding="utf-8")
    except FileNotFoundError as error:
        raise ShaderError(f"{wanted_by}: shaders/{name} is missing from this installation") from error
