"""Copies of unsaved work: a few at most, found when their window is gone and only then, whole or not at all."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from hqmodel import files
from hqmodel.edit import new_scene
from hqmodel.files.autosave import COPIES
from hqmodel.model import Scene

ROOT = Path(__file__).parents[2]
ORIGIN = files.Origin("clay", "/somewhere/clay.json", "0123")


def scene(name: str) -> Scene:
    return new_scene().changed(name=name)


def on_disk() -> list[Path]:
    return list(files.state_folder().rglob("*"))


def test_what_an_abandoned_window_left_is_found_once() -> None:
    ring = files.Ring()
    for name in "abcde":
        ring.keep(scene(name), ORIGIN)
    assert files.lost() == [], "its window runs"
    ring.abandon()
    (found,) = files.lost()
    assert found.origin == ORIGIN
    assert [files.load(copy).name for copy in found.copies] == ["e", "d", "c"][:COPIES]
    assert files.lost() == [], "somebody is being asked about it"
    found.release()
    (again,) = files.lost()
    again.discard()
    assert files.lost() == []
    assert [path for path in on_disk() if path.is_file()] == []


def test_nothing_is_on_the_disk_before_there_is_something_to_keep_nor_after() -> None:
    ring = files.Ring()
    ring.clear()
    assert on_disk() == []
    ring.keep(scene("a"), ORIGIN)
    ring.clear()
    assert [path.name for path in on_disk()] == ["autosave"]
    ring.keep(scene("b"), ORIGIN)
    ring.abandon()
    (found,) = files.lost()
    assert [files.load(copy).name for copy in found.copies] == ["b"]
    found.discard()


def test_another_documents_copies_go() -> None:
    ring = files.Ring()
    ring.keep(scene("a"), ORIGIN)
    ring.keep(scene("b"), files.Origin("other"))
    ring.abandon()
    (found,) = files.lost()
    assert (found.origin.name, len(found.copies)) == ("other", 1)
    found.release()


def test_the_latest_work_comes_first() -> None:
    for name in "abc":
        ring = files.Ring()
        path = ring.keep(scene(name), files.Origin(name))
        os.utime(path, (ord(name), ord(name)))
        ring.abandon()
    found = files.lost()
    assert [one.origin.name for one in found] == ["c", "b", "a"]
    assert found[0].time == ord("c")


@pytest.mark.parametrize("damage", [b"", b"[]", b'{"name": "a", "more": 1}', b"\xff"])
def test_work_whose_origin_cannot_be_read_is_found_all_the_same(damage: bytes) -> None:
    ring = files.Ring()
    copy = ring.keep(scene("a"), ORIGIN)
    ring.abandon()
    (copy.parent / "origin.json").write_bytes(damage)
    (found,) = files.lost()
    assert found.origin == files.Origin("Untitled")
    assert files.load(found.copies[0]).name == "a"


def test_what_never_held_a_copy_is_swept_away() -> None:
    folder = files.state_folder() / "autosave"
    (folder / "0123").mkdir(parents=True)
    (folder / "0123.lock").touch()
    assert files.lost() == []
    assert list(folder.iterdir()) == []


def test_where_nothing_can_be_written_it_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("not a folder")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "file"))
    with pytest.raises(OSError):
        files.Ring().keep(scene("a"), ORIGIN)


KEEPER = """
from hqmodel.edit import new_scene
from hqmodel.files import Origin, Ring

ring, number = Ring(), 0
while True:
    number += 1
    ring.keep(new_scene().changed(name=str(number)), Origin("clay"))
    print(number, flush=True)
"""


def test_killed_at_any_moment_the_last_copy_that_was_finished_is_there() -> None:
    for rounds in range(4):
        with subprocess.Popen([sys.executable, "-c", KEEPER], stdout=subprocess.PIPE, cwd=ROOT, text=True) as keeper:
            assert keeper.stdout is not None
            for _ in range(5 + rounds):
                finished = int(keeper.stdout.readline())
            assert files.lost() == [], "its window runs"
            keeper.send_signal(signal.SIGKILL)
            finished = max([finished, *(int(line) for line in keeper.stdout if line.endswith("\n"))])
        (found,) = files.lost()
        assert files.load(found.copies[0]).name in (str(finished), str(finished + 1))
        assert len(found.copies) <= COPIES + 1
        found.discard()
    assert [path for path in on_disk() if path.is_file()] == []
