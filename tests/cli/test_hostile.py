"""Damaged, hostile, wrong and empty presets: exit status 1, one clear line, and no output file."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from .conftest import BALL, Command, files


def changed(**changes: Any) -> bytes:
    return json.dumps({**BALL, **changes}).encode()


def strip(**changes: Any) -> bytes:
    return changed(shapes=[{"strips": [{"normal": [1, 0, 0], **changes}]}])


WHOLE = json.dumps(BALL).encode()
HOSTILE = {
    "empty": b"",
    "blank": b"\n\n",
    "cut off": WHOLE[:-30],
    "a flipped byte": WHOLE.replace(b"strips", b"str\x00ps"),
    "not UTF-8": WHOLE.replace(b"Ball", b"B\xe4ll"),
    "UTF-16": WHOLE.decode().encode("utf-16"),
    "a picture": b"\x89PNG\r\n\x1a\n" + bytes(range(256)),
    "a mesh": b"solid ball\nendsolid ball\n",
    "a list": b"[]",
    "a number": b"1",
    "nothing in it": b"{}",
    "another format": changed(format="gltf"),
    "a newer version": changed(version=99),
    "no version": b'{"format": "hqmodel", "shapes": []}',
    "NaN": WHOLE.replace(b"[1, 0, 0]", b"[NaN, 0, 0]"),
    "infinity": WHOLE.replace(b"[1, 0, 0]", b"[1e999, 0, 0]"),
    "a giant number": WHOLE.replace(b"[1, 0, 0]", b"[" + b"9" * 100_000 + b", 0, 0]"),
    "a key twice": WHOLE.replace(b'"version": 1', b'"version": 1, "version": 1'),
    "deep nesting": b'{"a":' * 200_000,
    "deep lists": WHOLE[:-1] + b', "x": ' + b"[" * 5000 + b"]" * 5000 + b"}",
    "too large": b" " * (4 << 20) + WHOLE,
    "half a surrogate pair": WHOLE.replace(b"Ball", b"\\ud800"),
    "too many shapes": changed(shapes=BALL["shapes"] * 257),
    "too many strips": changed(shapes=[{"strips": [{"normal": [1, 0, 0]}] * 1025}]),
    "no strips": changed(shapes=[{"strips": []}]),
    "a negative exponent": strip(gamma=-3),
    "a zero normal": strip(normal=[0, 0, 0]),
    "a zero half-width": strip(half_width=0),
    "true for a number": strip(gamma=True),
    "an unknown group": strip(group="rim"),
    "several problems": changed(name=5, slice="x", level=None),
    "no shapes": changed(shapes=[]),
    "nothing visible": changed(shapes=[{**BALL["shapes"][0], "visible": False}]),
    "no surface": changed(level=1e9),
    "without end": strip(),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_preset_at_fault_is_one_line_and_no_file(hqmodel: Command, name: str) -> None:
    Path("bad.json").write_bytes(HOSTILE[name])
    before = files()
    status, out, err = hqmodel("export", "bad.json", "-o", "a.obj", "-o", "a.stl", "--resolution", 16)
    assert (status, out) == (1, "")
    assert err.startswith("bad.json: ")
    assert err.endswith("\n")
    assert err.count("\n") == 1
    assert len(err) < 300
    assert files() == before


@pytest.mark.parametrize(
    "command", [["render", "-o", "a.png"], ["sample", "p.csv", "-o", "a.csv"], ["raycast", "r.csv", "-o", "a.csv"]]
)
def test_every_command_tells_it_the_same(hqmodel: Command, command: list[str]) -> None:
    Path("bad.json").write_bytes(HOSTILE["a negative exponent"])
    Path("p.csv").write_text("x,y,z\n0,0,0\n")
    Path("r.csv").write_text("ox,oy,oz,dx,dy,dz\n0,0,9,0,0,-1\n")
    before = files()
    status, out, err = hqmodel(command[0], "bad.json", *command[1:])
    assert (status, out) == (1, "")
    assert err == "bad.json: shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got -3\n"
    assert files() == before


def test_several_problems_are_counted_in_the_one_line(hqmodel: Command) -> None:
    Path("bad.json").write_bytes(HOSTILE["several problems"])
    assert hqmodel("export", "bad.json", "-o", "a.obj").err == "bad.json: name: expected text, got 5 (and 2 more)\n"


def test_names_are_shown_as_text(hqmodel: Command) -> None:
    Path("bad.json").write_bytes(changed(format="\x1b[31m\nred"))
    assert hqmodel("check", "bad.json").err == "bad.json: format: expected \"hqmodel\", got '\\x1b[31m\\nred'\n"
