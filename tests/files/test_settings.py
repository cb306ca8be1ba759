"""What is remembered between runs, and that nothing breaks where it can't be."""

from __future__ import annotations

from pathlib import Path

import pytest

from hqmodel.files import Settings, settings_folder
from hqmodel.files.settings import RECENT


def test_what_was_written_is_read() -> None:
    settings = Settings().opened("/a/b.json").preferring(theme="dark", size=[800, 600])
    assert settings.write()
    assert Settings.read() == settings


def test_at_first_there_are_the_defaults() -> None:
    assert Settings.read() == Settings()


@pytest.mark.parametrize(
    "damage", ["", "{", "[]", '{"recent": 5, "preferences": {}}', '{"recent": [], "preferences": 5}', "\xff"]
)
def test_damaged_settings_are_the_defaults(damage: str) -> None:
    settings_folder().mkdir(parents=True)
    (settings_folder() / "settings.json").write_text(damage, encoding="latin-1")
    assert Settings.read() == Settings()


def test_a_home_that_cannot_be_written_is_no_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("not a folder")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "file"))
    assert Settings().opened("/a.json").write() is False
    assert Settings.read() == Settings()


def test_the_latest_file_is_the_first_of_a_few() -> None:
    settings = Settings()
    for number in range(20):
        settings = settings.opened(f"/{number}.json")
    settings = settings.opened("/15.json")
    assert settings.recent[:3] == ("/15.json", "/19.json", "/18.json")
    assert len(settings.recent) == RECENT
    assert settings.forgetting("/19.json").recent[:2] == ("/15.json", "/18.json")


def test_paths_are_kept_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert Settings().opened("a.json").recent == (str(tmp_path / "a.json"),)
