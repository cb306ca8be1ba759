"""What our own file dialog lists, and the path that it gives."""

from __future__ import annotations

from pathlib import Path

from hqmodel.app.asks import ChooseFile
from hqmodel.app.browse import listing


def test_folders_and_fitting_files_in_order(tmp_path: Path) -> None:
    for name in ("b.json", "A.JSON", "c.txt", ".hidden.json"):
        (tmp_path / name).touch()
    for name in ("z", "Y", ".git"):
        (tmp_path / name).mkdir()
    found = listing(tmp_path, (".json",))
    assert found.folders == ("Y", "z")
    assert found.files == ("A.JSON", "b.json")
    assert found.problem == ""


def test_a_folder_that_cannot_be_read_says_why(tmp_path: Path) -> None:
    missing = tmp_path / "nowhere"
    assert listing(missing, (".json",)).problem == f"{missing}: No such file or directory"


def test_a_file_to_be_written_gets_its_ending(tmp_path: Path) -> None:
    assert ChooseFile("save", tmp_path, "egg").path == tmp_path / "egg.json"
    assert ChooseFile("save", tmp_path, "egg.v2").path == tmp_path / "egg.v2.json"
    assert ChooseFile("save", tmp_path, "egg.JSON").path == tmp_path / "egg.JSON"
    assert ChooseFile("open", tmp_path, "egg").path == tmp_path / "egg"
