"""What the Presets panel lists, and what a search leaves of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from hqmodel import files
from hqmodel.app import shelf
from hqmodel.app.intents import Prefer
from hqmodel.app.session import Session
from hqmodel.app.shelf import stocked
from hqmodel.edit import new_scene


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "mine"
    folder.mkdir()
    monkeypatch.setattr(shelf, "own_folder", lambda: folder)
    return folder


def test_every_built_in_preset_is_there_starters_first(own: Path) -> None:
    found = stocked().found(files.Settings())
    assert next(iter(found)) == "Starters"
    assert {card.path for cards in found.values() for card in cards} == {preset.path for preset in files.builtin()}


def test_favourites_recent_files_and_ones_own(own: Path, tmp_path: Path) -> None:
    for path in (own / "b.json", own / "A.json", tmp_path / "lately.json"):
        files.save(new_scene(), path)
    star = files.builtin()[0]
    settings = files.Settings().opened(tmp_path / "gone.json").opened(tmp_path / "lately.json")
    found = stocked().found(settings.preferring(favourites=[str(star.path), str(own / "b.json"), 5]))
    assert [card.title for card in found["Favourites"]] == [star.title, "b"]
    assert [card.path for card in found["Recent"]] == [tmp_path / "lately.json"]
    assert [card.title for card in found["My presets"]] == ["A", "b"]


def test_a_search_leaves_what_has_all_the_words(own: Path) -> None:
    panel = stocked()
    preset = files.builtin()[3]
    panel.search = f"{preset.title.upper()} {preset.collection}"
    assert preset.path in [card.path for cards in panel.found(files.Settings()).values() for card in cards]
    panel.search = "no preset has these words"
    assert panel.found(files.Settings()) == {}


def test_a_star_is_remembered() -> None:
    session = Session(files.Settings())
    session.apply([Prefer("favourites", ["/a.json"])])
    assert shelf.favourites(files.Settings.read()) == ["/a.json"]
    assert shelf.favourites(files.Settings(preferences={"favourites": "spoilt"})) == []
