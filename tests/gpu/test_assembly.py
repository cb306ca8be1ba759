"""Shaders put together: every file compiles in every form, faults are named by file and line."""

from __future__ import annotations

import re
import signal
from pathlib import Path

import moderngl
import pytest

from hqmodel.gpu import ShaderError, assembly
from hqmodel.gpu.assembly import Source, assemble, program
from hqmodel.gpu.layout import ROWS
from hqmodel.gpu.tracing import KINDS
from hqmodel.resources import folder

# What packing.py can ask for, from the barest to all.
SCENES = (
    (),
    ("CELLS",),
    ("LONE",),
    ("LONE", "CONVEX"),
    ("GROUPS", "LONE", "CONVEX"),
    ("GROUPS", "LONE"),
    ("GROUPS", "HYPERBOLIC", "CARVING", "CELLS"),
)
SHADERS = sorted(path.name for path in folder("shaders").iterdir())


@pytest.mark.parametrize("defines", SCENES, ids="-".join)
@pytest.mark.parametrize("kind", KINDS)
def test_tracing_compiles(ctx: moderngl.Context, kind: str, defines: tuple[str, ...]) -> None:
    program(ctx, "trace.frag", (*KINDS[kind], *defines)).release()


@pytest.mark.parametrize("name", [name for name in SHADERS if name.endswith(".frag") and name != "trace.frag"])
@pytest.mark.parametrize("defines", [("CURVATURE",), ("GROUPS", "HYPERBOLIC", "CELLS", "CURVATURE", "DRAFT")], ids="-".join)
def test_the_others_compile(ctx: moderngl.Context, name: str, defines: tuple[str, ...]) -> None:
    program(ctx, name, defines).release()


def test_every_file_is_used_by_some_program() -> None:
    mains = [name for name in SHADERS if name.endswith((".frag", ".vert"))]
    used = {file for name in mains for file in assemble(name).files}
    assert used == {*SHADERS, *assembly.GENERATED}


def test_every_row_field_is_used_by_the_shaders() -> None:
    text = "".join((folder("shaders") / name).read_text() for name in SHADERS)
    read = {field.name for row in ROWS for field in row.fields if re.search(rf"\.{field.name}\b", text)}
    assert {field.name for row in ROWS for field in row.fields} == read


@pytest.fixture
def shaders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(assembly, "folder", lambda name: tmp_path)
    (tmp_path / "screen.vert").write_text((folder("shaders") / "screen.vert").read_text())
    return tmp_path


def test_an_include_is_put_in_once(shaders: Path) -> None:
    (shaders / "a.frag").write_text('#version 330 core\n#include "b.glsl"\n#include "c.glsl"\nvoid main() {}\n')
    (shaders / "b.glsl").write_text('#include "c.glsl"\nfloat b;\n')
    (shaders / "c.glsl").write_text("float c;\n")
    source = assemble("a.frag", ("GROUPS",))
    assert source.files == ("a.frag", "b.glsl", "c.glsl")
    assert source.text.count("float c;") == 1
    assert source.text.splitlines()[:2] == ["#version 330 core", "#define GROUPS"]


@pytest.mark.parametrize(
    ("broken", "place"),
    [("a.frag", "a.frag:5:"), ("b.glsl", "b.glsl:3:"), ("c.glsl", "c.glsl:2:")],
)
def test_a_fault_is_named_by_file_and_line(ctx: moderngl.Context, shaders: Path, broken: str, place: str) -> None:
    texts = {
        "a.frag": ["#version 330 core", '#include "b.glsl"', "out vec4 color;", "void main() {", "color = vec4(1.0);", "}"],
        "b.glsl": ["float b;", '#include "c.glsl"', "float d;"],
        "c.glsl": ["float c;", "float e;"],
    }
    texts[broken][int(place.split(":")[1]) - 1] = "nonsense;"
    for name, lines in texts.items():
        (shaders / name).write_text("\n".join(lines))
    with pytest.raises(ShaderError, match=re.escape(place)):
        program(ctx, "a.frag")


def test_a_missing_include_is_named(shaders: Path) -> None:
    (shaders / "a.frag").write_text('#version 330 core\n\n#include "gone.glsl"\n')
    with pytest.raises(ShaderError, match=re.escape("a.frag:3: shaders/gone.glsl is missing")):
        assemble("a.frag")


@pytest.mark.parametrize(
    ("log", "readable"),
    [
        ("1:12(7): error: no", "field.glsl:12: error: no"),
        ("1(12) : error C1008: no", "field.glsl:12: error C1008: no"),
        ("ERROR: 1:12: 'x' : undeclared", "ERROR: field.glsl:12: 'x' : undeclared"),
        ("9:12: of no file", "9:12: of no file"),
    ],
)
def test_compilers_logs_are_read(log: str, readable: str) -> None:
    assert Source("", ("trace.frag", "field.glsl")).readable(log) == readable


def test_an_interrupt_waits_until_a_program_is_made() -> None:
    """moderngl calls back into Python meanwhile, and crashes where something is raised there."""

    class Interrupted:
        made = False

        def program(self, **_: str) -> None:
            signal.raise_signal(signal.SIGINT)
            self.made = True

    ctx = Interrupted()
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # jobs in a shell's background don't heed it
    try:
        with pytest.raises(KeyboardInterrupt):
            program(ctx, "mark.frag")  # type: ignore[arg-type]
        assert ctx.made
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    finally:
        signal.signal(signal.SIGINT, before)
