"""presets: what is built in."""

from __future__ import annotations

import json

from hqmodel.files import builtin

from .conftest import Command


def test_each_is_listed_with_its_title(hqmodel: Command) -> None:
    ended = hqmodel("presets")
    assert (ended.status, ended.err) == (0, "")
    assert [line.split(maxsplit=1) for line in ended.out.splitlines()] == [[p.name, p.title] for p in builtin()]


def test_json_says_more(hqmodel: Command) -> None:
    listed = json.loads(hqmodel("presets", "--json").out)["presets"]
    assert [preset["name"] for preset in listed] == [preset.name for preset in builtin()]
    assert set(listed[0]) == {"name", "title", "description", "collection", "file"}


def test_each_can_be_named(hqmodel: Command) -> None:
    assert hqmodel("check", "-q", *[preset.name for preset in builtin()]) == (0, "", "")
