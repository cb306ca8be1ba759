"""One declaration: what NumPy packs, the shader's generated functions read."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest

from hqmodel.gpu import layout
from hqmodel.gpu.layout import ROWS, STRIP, TERM, WIDTH, Field, Row
from hqmodel.gpu.screen import Target
from hqmodel.gpu.tables import read

_MAIN = """#version 330 core
{access}
uniform int row;
out vec4 values;
void main() {{ values = vec4({name}_row(row).{field}{fill}); }}
"""


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.name)
def test_rows_fill_whole_texels(row: Row) -> None:
    places = row.places()
    assert row.dtype.itemsize == 16 * row.texels
    for field in row.fields:
        texel, parts = places[field.name]
        assert row.dtype.fields is not None
        assert row.dtype.fields[field.name][1] == 16 * texel + 4 * "xyzw".index(parts[0])


def test_a_field_across_texels_is_refused() -> None:
    with pytest.raises(ValueError, match=r"Bad\.b lies across two texels"):
        Row("Bad", (Field("a", 3, ""), Field("b", 3, ""))).places()
    with pytest.raises(ValueError, match="Short takes 3 numbers"):
        Row("Short", (Field("a", 3, ""),)).places()


@pytest.mark.parametrize(("row", "field"), [(row, field) for row in ROWS for field in row.fields], ids=lambda x: x.name)
def test_the_shader_reads_what_was_packed(ctx: moderngl.Context, row: Row, field: Field) -> None:
    count = 700  # more than one line of the texture
    rows = np.zeros(count, dtype=row.dtype)
    rows.view(np.float32)[:] = np.arange(rows.nbytes // 4) + 0.5
    texels = np.zeros((rows.nbytes // 16 // WIDTH + 1, WIDTH, 4), dtype=np.float32)
    texels.ravel()[: rows.nbytes // 4] = rows.view(np.float32)
    memory = ctx.texture((WIDTH, len(texels)), 4, texels.tobytes(), dtype="f4")
    fill = {1: ", 0.0, 0.0, 0.0", 3: ", 0.0"}[field.size]
    source = _MAIN.format(access=layout.glsl(), name=row.name.lower(), field=field.name, fill=fill)
    vertex = "#version 330 core\nvoid main() { gl_Position = vec4(ivec2(gl_VertexID % 2, gl_VertexID / 2) * 4 - 1, 0.0, 1.0); }"
    program = ctx.program(vertex_shader=vertex, fragment_shader=source)
    target = Target(ctx, (1, 1))
    target.framebuffer.use()
    memory.use(0)
    program[f"{row.name.lower()}_rows"] = 0
    for index in (0, 1, 340, count - 1):
        program["row"] = index
        ctx.vertex_array(program, []).render(vertices=3)
        got = read(target.texture)[0, : field.size]
        np.testing.assert_array_equal(got, np.atleast_1d(rows[field.name][index]))
    ctx.detect_framebuffer(0).use()


def test_names_are_the_shaders() -> None:
    text = layout.glsl()
    for row in (TERM, STRIP):
        assert f"{row.name} {row.name.lower()}_row(int index)" in text
