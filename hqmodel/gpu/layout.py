"""How the scene lies in GPU memory: declared here once; the NumPy dtypes and the shader's structs both come from it.

Memory is one texture of RGBA32F texels, read by `texelFetch` (all that OpenGL 3.3 and macOS have in common): rows of
`TERM` first, then rows of `STRIP`, folded into lines of `WIDTH` texels.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

WIDTH = 1024
_PARTS = "xyzw"
_TYPES = {1: "float", 3: "vec3"}


@dataclass(frozen=True)
class Field:
    """One value of a row: its name, how many numbers it holds, and what it is."""

    name: str
    size: int
    meaning: str


@dataclass(frozen=True)
class Row:
    """A record of whole texels; no field lies across two of them."""

    name: str
    fields: tuple[Field, ...]

    @property
    def dtype(self) -> np.dtype[np.void]:
        """The record as NumPy packs it, float32 throughout."""
        return np.dtype([(field.name, "<f4", (field.size,) if field.size > 1 else ()) for field in self.fields])

    @property
    def texels(self) -> int:
        """Texels a record takes."""
        return self.dtype.itemsize // 16

    def places(self) -> dict[str, tuple[int, str]]:
        """For each field its texel in the record and its components there, as ``{"offset": (0, "w")}``.

        Raises ValueError where a field would lie across texels or the record does not fill its last one.
        """
        result, at = {}, 0
        for field in self.fields:
            if at % 4 + field.size > 4:
                raise ValueError(f"{self.name}.{field.name} lies across two texels: order the fields to fill texels of 4")
            result[field.name] = at // 4, _PARTS[at % 4 : at % 4 + field.size]
            at += field.size
        if at % 4:
            raise ValueError(f"{self.name} takes {at} numbers: fill it up to a multiple of 4")
        return result

    def glsl(self) -> str:
        """The struct, and the function ``Name name_row(int index)`` that reads one."""
        places = self.places()
        lines = [f"struct {self.name} {{"]
        lines += [f"    {_TYPES[field.size]} {field.name}; // {field.meaning}" for field in self.fields]
        lines += ["};", "", f"{self.name} {self.name.lower()}_row(int index)", "{"]
        lines += [f"    int at = {self.name.lower()}_rows + index * {self.texels};"]
        lines += [f"    vec4 texel_{i} = scene_texel(at + {i});" for i in range(self.texels)]
        values = ", ".join(f"texel_{texel}.{parts}" for texel, parts in places.values())
        return "\n".join([*lines, f"    return {self.name}({values});", "}", ""])


TERM = Row(
    "Term",
    (
        Field("first", 1, "its first strip's row"),
        Field("count", 1, "how many strips it has"),
        Field("hardness", 1, "beta"),
        Field("constant", 1, "C"),
        Field("low", 3, "the box where it matters, in the unit frame"),
        Field("log_coefficient", 1, "ln |c|"),
        Field("high", 3, ""),
        Field("adds", 1, "the sign of c: 1 adds, -1 carves"),
        Field("color", 3, "linear light"),
        Field("hyperbolic", 1, "1 where any sigma is negative"),
    ),
)
STRIP = Row(
    "Strip",
    (
        Field("normal", 3, "h = normal . x + offset, in the unit frame"),
        Field("offset", 1, ""),
        Field("inner", 1, "g, the exponent in its group"),
        Field("outer", 1, "G, its group's exponent; g for a lone strip"),
        Field("sigma", 1, "its group's sign"),
        Field("members", 1, "strips in the group that begins here; 0 for those that follow"),
        Field("tint", 3, "its colour in the strips mode, linear light"),
        Field("reach", 1, "|h| where its term matters is at most this; negative where it never does"),
    ),
)
ROWS = (TERM, STRIP)


def glsl() -> str:
    """The whole of the shader's access to the scene: ``#include "layout.glsl"``."""
    head = [
        "uniform sampler2D scene_memory;",
        *[f"uniform int {row.name.lower()}_rows; // its first texel" for row in ROWS],
        "uniform int term_count;",
        "",
        "vec4 scene_texel(int at)",
        "{",
        f"    return texelFetch(scene_memory, ivec2(at % {WIDTH}, at / {WIDTH}), 0);",
        "}",
        "",
    ]
    return "\n".join([*head, *[row.glsl() for row in ROWS]])
