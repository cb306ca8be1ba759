"""Nothing is lost: copies while one works, the way back to them after a crash, and files that others wrote to meanwhile."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from time import monotonic, sleep

import pytest

from hqmodel import files
from hqmodel.app import editing, filing, recovery
from hqmodel.app.asks import ChooseFile, Open, Overwrite, Problem, Quit, Recover, Recovered
from hqmodel.app.intents import Answer, Do, Put
from hqmodel.app.session import Session
from hqmodel.edit import new_scene

from .outside import ROOT, SECONDS, surroundings

GAMMA = ("shapes", 0, "strips", 0, "gamma")


@pytest.fixture
def session(monkeypatch: pytest.MonkeyPatch) -> Session:
    monkeypatch.setattr(recovery, "PERIOD", 0.0)
    return Session(files.Settings())


@pytest.fixture
def preset(tmp_path: Path) -> Path:
    path = tmp_path / "clay.json"
    files.save(new_scene(), path)
    return path


def work(session: Session, gamma: float) -> None:
    session.apply([Put(GAMMA, gamma, "Exponent")])


def crash(session: Session) -> None:
    """The window is gone, and what is not saved is where it was kept."""
    session.poll()
    session.recovery.close(keep=True)


def offered() -> Session:
    session = Session(files.Settings())
    filing.offer(session, files.lost())
    return session


def answered(session: Session, wanted: bool, number: int = 0) -> None:
    dialog = session.dialogs[-1]
    assert isinstance(dialog, Recover)
    session.apply([Answer(Recovered(dialog.lost[number], wanted))])


def test_after_a_crash_one_goes_on_where_one_was(session: Session, preset: Path) -> None:
    session.apply([Open(preset)])
    work(session, 9.0)
    session.apply([Do("mode depth")])
    crash(session)
    assert files.load(preset).shapes[0].strips[0].gamma == 2.0
    after = offered()
    answered(after, wanted=True)
    assert after.document.title == "clay* - hqmodel"
    assert (after.document.path, after.scene.shapes, after.view) == (preset, session.scene.shapes, session.view)
    after.apply([Do("save")])
    assert files.load(preset).shapes[0].strips[0].gamma == 9.0
    after.poll()
    after.recovery.close(keep=True)
    assert files.lost() == []


def test_recovered_work_survives_the_next_crash_at_once(session: Session) -> None:
    work(session, 9.0)
    crash(session)
    after = offered()
    answered(after, wanted=True)
    after.recovery.close(keep=True)
    again = offered()
    answered(again, wanted=True)
    assert again.scene.shapes == session.scene.shapes
    assert again.document.path is None


def test_asked_again_next_time_or_thrown_away(session: Session) -> None:
    work(session, 9.0)
    crash(session)
    after = offered()
    after.apply([Answer()])
    assert not after.dialogs
    after = offered()
    answered(after, wanted=False)
    assert not after.dialogs
    assert files.lost() == []


@pytest.mark.parametrize("goodbye", ["undo", "save", "quit"])
def test_what_is_saved_or_given_up_is_not_offered(session: Session, tmp_path: Path, goodbye: str) -> None:
    work(session, 9.0)
    session.poll()
    if goodbye == "save":
        filing.save(session, tmp_path / "mine.json")
    elif goodbye == "undo":
        editing.undo(session)
    else:
        session.apply([Quit(), Answer("discard")])
        assert session.finished
    session.poll()
    session.recovery.close(keep=goodbye != "quit")
    assert files.lost() == []


def test_of_several_the_others_are_offered_again(session: Session) -> None:
    other = Session(files.Settings())
    for gamma, one in ((9.0, session), (5.0, other)):
        work(one, gamma)
        crash(one)
    after = offered()
    answered(after, wanted=False)
    assert isinstance(after.dialogs[-1], Recover)
    assert len(after.dialogs[-1].lost) == 1
    after.apply([Answer()])
    assert len(files.lost()) == 1


def test_a_damaged_copy_is_told_of_and_the_one_before_it_is_taken(session: Session) -> None:
    for gamma in (5.0, 9.0):
        work(session, gamma)
        session.recovery.keep(session)
    crash(session)
    latest, before = sorted(files.state_folder().rglob("0*.json"), reverse=True)
    latest.write_bytes(latest.read_bytes()[:-40])
    after = offered()
    answered(after, wanted=True)
    problem = after.dialogs.pop()
    assert isinstance(problem, Problem)
    assert len(problem.lines) == 1
    assert problem.lines[0].startswith(f"{latest}: ")
    assert after.scene.shapes[0].strips[0].gamma == 5.0
    assert not before.exists(), "it is kept as this window's own now"


def test_where_no_copy_can_be_read_it_says_why_and_leaves_the_choice(session: Session) -> None:
    work(session, 9.0)
    crash(session)
    (copy,) = files.state_folder().rglob("0*.json")
    copy.write_bytes(b'{"format": "hqmodel", "version": 1, "shapes": 5}')
    after = offered()
    untouched = after.scene
    answered(after, wanted=True)
    problem = after.dialogs.pop()
    assert isinstance(problem, Problem)
    assert problem.lines == (f"{copy}: shapes: expected a list, got 5",)
    assert after.scene is untouched
    answered(after, wanted=False)
    assert files.lost() == []


def test_a_copy_that_cannot_be_written_is_said(session: Session, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "file"))
    blocked = Session(files.Settings())
    work(blocked, 9.0)
    assert blocked.recovery.keep(blocked) is None
    work(blocked, 8.0)
    blocked.poll()
    blocked.recovery.close()
    blocked.poll()
    assert blocked.failed
    assert blocked.message.startswith("No copy for safety: ")


def test_what_another_program_wrote_is_not_overwritten_unasked(session: Session, preset: Path, tmp_path: Path) -> None:
    session.apply([Open(preset)])
    work(session, 9.0)
    files.save(new_scene().changed(name="theirs"), preset)
    session.apply([Do("save")])
    assert session.dialogs == [Overwrite(preset)]
    session.apply([Answer()])
    assert files.load(preset).name == "theirs"
    session.apply([Do("save"), Answer("elsewhere")])
    assert isinstance(session.dialogs[-1], ChooseFile)
    session.apply([Answer(None), Do("save"), Answer("overwrite")])
    assert files.load(preset).shapes[0].strips[0].gamma == 9.0
    assert not session.history.dirty
    assert [files.load(path).name for path in files.backup_folder(preset).iterdir()] == ["theirs"]
    work(session, 8.0)
    session.apply([Do("save")])
    assert not session.dialogs, "nobody else has written to it since"


def test_an_overtaken_file_is_asked_about_on_the_way_out_too(session: Session, preset: Path) -> None:
    session.apply([Open(preset)])
    work(session, 9.0)
    preset.write_text("theirs")
    session.apply([Quit(), Answer("save")])
    assert not session.finished
    session.apply([Answer("overwrite")])
    assert session.finished


def test_recovered_work_does_not_overwrite_what_came_after_it(session: Session, preset: Path) -> None:
    session.apply([Open(preset)])
    work(session, 9.0)
    crash(session)
    files.save(new_scene().changed(name="theirs"), preset)
    after = offered()
    answered(after, wanted=True)
    after.apply([Do("save")])
    assert after.dialogs == [Overwrite(preset)]


def test_an_earlier_version_opens_as_a_new_preset(session: Session, preset: Path) -> None:
    session.apply([Open(preset), Do("versions")])
    assert not session.dialogs, "there is none yet"
    work(session, 9.0)
    session.apply([Do("save"), Do("versions")])
    asked = session.dialogs[-1]
    assert isinstance(asked, ChooseFile)
    (version,) = asked.folder.iterdir()
    session.apply([Answer(version)])
    assert session.scene.shapes[0].strips[0].gamma == 2.0
    assert session.document.path is None


VICTIM = """
from hqmodel.app import recovery
from hqmodel.app.intents import Do
from hqmodel.app.session import Session
from hqmodel.app.window import Window
from hqmodel.files import Settings

recovery.PERIOD = 0.0
session = Session(Settings().preferring(refining=False))
session.hidden_panels.add("Presets")  # its thumbnails would take most of the time
session.apply([Do("add block")])
Window(session).run()
"""
HEIR = """
from hqmodel import load
from hqmodel.files import lost

print([[shape.name for shape in load(one.copies[0]).shapes] for one in lost()])
"""


def test_a_killed_window_leaves_its_work_and_a_running_one_keeps_its_own(display: str, tmp_path: Path) -> None:
    """SIGKILL, from outside: only then is what was made offered to the next one."""
    environment = surroundings(display, tmp_path)

    def found() -> str:
        command = [sys.executable, "-c", HEIR]
        return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=SECONDS).stdout.strip()

    with subprocess.Popen([sys.executable, "-c", VICTIM], env=environment, cwd=ROOT) as victim:
        try:
            deadline = monotonic() + SECONDS
            while not list(tmp_path.rglob("0*.json")):
                assert victim.poll() is None
                assert monotonic() < deadline, f"no copy in {SECONDS} seconds"
                sleep(0.1)
            assert found() == "[]"
        finally:
            victim.kill()
    assert found() == "[['Ball', 'Block']]"
