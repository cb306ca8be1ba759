"""Earlier versions of a file: the last few, each once, and none when the system does not let us."""

from __future__ import annotations

from pathlib import Path

import pytest

from hqmodel import files
from hqmodel.files.backups import FILES, VERSIONS


def versions(path: Path) -> set[str]:
    return {version.read_text() for version in files.backup_folder(path).glob("*.json")}


def test_the_last_versions_are_kept(tmp_path: Path) -> None:
    path = tmp_path / "clay.json"
    assert files.back_up(path), "there is nothing yet to be kept"
    for number in range(VERSIONS + 3):
        path.write_text(str(number))
        assert files.back_up(path)
    assert versions(path) == {str(number) for number in range(3, VERSIONS + 3)}


def test_the_same_version_is_kept_once(tmp_path: Path) -> None:
    path = tmp_path / "clay.json"
    path.write_text("a")
    assert files.back_up(path)
    assert files.back_up(path)
    assert len(list(files.backup_folder(path).iterdir())) == 1


def test_files_of_one_name_are_told_apart_and_a_link_is_its_file(tmp_path: Path) -> None:
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "clay.json").write_text(folder)
        files.back_up(tmp_path / folder / "clay.json")
    (tmp_path / "link.json").symlink_to(tmp_path / "a" / "clay.json")
    assert versions(tmp_path / "a" / "clay.json") == {"a"} == versions(tmp_path / "link.json")
    assert versions(tmp_path / "b" / "clay.json") == {"b"}


def test_versions_of_long_forgotten_files_go(tmp_path: Path) -> None:
    for number in range(FILES + 2):
        path = tmp_path / f"{number}.json"
        path.write_text("a")
        files.back_up(path)
    assert len(list((files.state_folder() / "backups").iterdir())) == FILES
    assert versions(tmp_path / "0.json") == set()
    assert versions(path) == {"a"}


def test_where_nothing_can_be_written_it_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "clay.json"
    path.write_text("a")
    monkeypatch.setenv("XDG_STATE_HOME", str(path))
    assert not files.back_up(path)


def test_a_fingerprint_tells_contents_apart(tmp_path: Path) -> None:
    path = tmp_path / "clay.json"
    assert files.fingerprint(path) is None
    path.write_text("a")
    first = files.fingerprint(path)
    path.write_text("b")
    assert files.fingerprint(path) != first
    path.write_text("a")
    assert files.fingerprint(path) == first
