"""The presets that come with the program: valid, described, and found by name."""

from __future__ import annotations

from pathlib import Path

import pytest

from hqmodel.files import Builtin, PresetError, builtin, dumps, load
from hqmodel.files.builtin import similar


def test_there_are_at_least_twelve_starters_each_with_a_name_of_its_own() -> None:
    presets = builtin()
    assert sum(preset.collection == "starters" for preset in presets) >= 12
    names = [preset.name.casefold() for preset in presets] + [preset.title.casefold() for preset in presets]
    owners = {(name, preset.path) for preset in presets for name in (preset.name.casefold(), preset.title.casefold())}
    assert len(owners) == len(set(names))


@pytest.mark.parametrize("preset", builtin(), ids=lambda preset: preset.name)
def test_each_loads_and_says_what_it_is(preset: Builtin) -> None:
    scene = load(preset.path)
    assert scene.name == preset.title
    assert scene.description == preset.description != ""


@pytest.mark.parametrize("preset", builtin(), ids=lambda preset: preset.name)
def test_each_is_found_by_its_name_and_its_title_in_any_case(preset: Builtin) -> None:
    scene = load(preset.path)
    for name in (preset.name, preset.name.upper(), preset.title, preset.title.replace(" ", "-").lower()):
        assert dumps(load(name)) == dumps(scene)


def test_a_file_comes_before_a_built_in_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    name = builtin()[0].name
    monkeypatch.chdir(tmp_path)
    (tmp_path / name).write_text('{"format": "hqmodel", "version": 1, "name": "mine", "shapes": []}')
    assert load(name).name == "mine"


def test_a_slip_is_told_with_what_comes_close() -> None:
    name = builtin()[0].name
    slip = name[:-1] + ("x" if name[-1] != "x" else "y")
    assert name in similar(slip)
    with pytest.raises(PresetError) as caught:
        load(slip)
    message = str(caught.value)
    assert message.startswith(f"{slip}: expected a preset file or a built-in preset's name, got nothing of that name (built in: ")
    assert name in message
    assert len(message.splitlines()) == 1


def test_nothing_comes_close_to_nonsense() -> None:
    with pytest.raises(PresetError, match=r"^qqqqqqqq: expected .*, got nothing of that name$"):
        load("qqqqqqqq")
