"""The session without a window: opening, editing, undo, saving, and what is asked before work is lost."""

from __future__ import annotations

from pathlib import Path

import pytest

from hqmodel import files
from hqmodel.app.asks import Choice, ChooseFile, New, Open, Problem, Quit, Unsaved
from hqmodel.app.intents import Adjust, Answer, Ask, Do, Edit, Grab, Look, Put, Release, Reset, Resize, Select
from hqmodel.app.session import Session
from hqmodel.edit import new_shape
from hqmodel.model import Camera, Scene

GAMMA = ("shapes", 0, "strips", 0, "gamma")


@pytest.fixture
def session() -> Session:
    return Session(files.Settings())


@pytest.fixture
def preset(tmp_path: Path) -> Path:
    path = tmp_path / "two shapes.json"
    files.save(Scene(name="Two", shapes=(new_shape("block"), new_shape("ball"))), path)
    return path


def gamma(session: Session) -> float:
    return session.scene.shapes[0].strips[0].gamma


def drag(session: Session, *values: float) -> None:
    session.apply([Grab(GAMMA, "Exponent"), *(Put(GAMMA, value, "Exponent") for value in values), Release()])


def test_it_starts_with_a_ball_that_is_selected_and_in_view(session: Session) -> None:
    assert [shape.name for shape in session.scene.shapes] == ["Ball"]
    assert session.selection.active == 0
    assert session.document.title == "Untitled - hqmodel"
    corner = session.view.camera.project([session.region.low, session.region.high], session.size)
    assert ((corner > 0) & (corner < session.size)).all()


def test_it_stays_in_view_when_the_window_is_resized_until_the_camera_is_moved(session: Session) -> None:
    session.apply([Resize((300, 900))])
    corner = session.view.camera.project([session.region.low, session.region.high], (300, 900))
    assert ((corner > 0) & (corner < (300, 900))).all()
    moved = session.view.camera.orbited(20, 0)
    session.apply([Look(moved), Resize((500, 500))])
    assert session.view.camera == moved
    assert session.size == (500, 500)


def test_a_drag_is_one_step_and_is_seen_while_it_lasts(session: Session) -> None:
    session.apply([Grab(GAMMA, "Exponent"), Put(GAMMA, 3.0, "Exponent"), Put(GAMMA, 8.0, "Exponent")])
    assert gamma(session) == 8.0
    session.apply([Release()])
    assert session.history.labels == ["Exponent"]
    session.apply([Do("undo")])
    assert gamma(session) == 2.0
    session.apply([Do("redo")])
    assert gamma(session) == 8.0


def test_a_drag_that_leads_nowhere_is_no_step(session: Session) -> None:
    drag(session, 5.0, 2.0)
    assert session.history.labels == []
    assert not session.history.dirty


def test_undo_in_the_middle_of_a_drag_takes_it_back(session: Session) -> None:
    session.apply([Grab(GAMMA, "Exponent"), Put(GAMMA, 8.0, "Exponent"), Do("undo")])
    assert gamma(session) == 2.0
    assert not session.history.dragging


def test_reset_forgets_the_click_that_came_before_it(session: Session) -> None:
    drag(session, 12.0)
    drag(session, 3.0)  # the first click of a double click has moved the slider
    session.apply([Grab(GAMMA, "Exponent"), Reset(GAMMA, "Exponent")])
    assert gamma(session) == 2.0
    session.apply([Do("undo")])
    assert gamma(session) == 12.0


def test_reset_keeps_a_drag_that_the_click_did_not_change(session: Session) -> None:
    drag(session, 12.0)
    drag(session)
    session.apply([Grab(GAMMA, "Exponent"), Reset(GAMMA, "Exponent"), Do("undo")])
    assert gamma(session) == 12.0


def test_what_is_not_permitted_is_said_and_not_done(session: Session) -> None:
    session.apply([Put(GAMMA, -3.0, "Exponent")])
    assert gamma(session) == 2.0
    assert session.failed
    assert session.message == "shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got -3.0"


def test_the_star_comes_with_a_change_and_goes_with_undo_and_saving(session: Session, tmp_path: Path) -> None:
    drag(session, 9.0)
    assert session.document.title == "Untitled* - hqmodel"
    session.apply([Do("undo")])
    assert session.document.title == "Untitled - hqmodel"
    session.apply([Do("redo"), Do("save")])
    assert isinstance(session.dialogs[-1], ChooseFile)
    session.apply([Answer(tmp_path / "mine.json")])
    assert session.document.title == "mine - hqmodel"
    assert session.settings.recent[0] == str(tmp_path / "mine.json")


def test_the_file_is_what_the_screen_showed(session: Session, tmp_path: Path) -> None:
    camera = Camera((1.0, 2.0, 3.0), 7.0, 10.0, 20.0, 30.0, True)
    drag(session, 9.0)
    session.apply([Look(camera), Do("mode normals"), Do("save"), Answer(tmp_path / "mine.json")])
    other = Session(files.Settings())
    other.apply([Open(tmp_path / "mine.json")])
    assert other.scene.changed(view={}) == session.scene.changed(view={})
    assert other.view == session.view
    assert not other.history.dirty


def test_save_goes_to_the_same_file_without_asking(session: Session, preset: Path) -> None:
    session.apply([Open(preset)])
    drag(session, 9.0)
    session.apply([Do("save")])
    assert not session.dialogs
    assert files.load(preset).shapes[0].strips[0].gamma == 9.0


def test_a_held_slider_is_let_go_before_saving(session: Session, preset: Path) -> None:
    session.apply([Open(preset), Grab(GAMMA, "Exponent"), Put(GAMMA, 9.0, "Exponent"), Do("save")])
    assert files.load(preset).shapes[0].strips[0].gamma == 9.0
    assert not session.history.dirty


def test_a_built_in_preset_is_a_new_one_to_be_saved_elsewhere(session: Session) -> None:
    for builtin in files.builtin():
        before = builtin.path.read_bytes()
        session.apply([Open(builtin.path), Do("save")])
        assert isinstance(session.dialogs.pop(), ChooseFile)
        assert builtin.path.read_bytes() == before
        assert str(builtin.path) not in session.settings.recent


@pytest.mark.parametrize("departure", [New(), Quit(), Open(Path("elsewhere.json"))])
def test_work_is_never_lost_without_a_question(session: Session, departure: New | Quit | Open) -> None:
    drag(session, 9.0)
    session.apply([departure])
    assert session.dialogs == [Unsaved("Untitled", departure)]
    assert not session.finished
    session.apply([Answer(None)])
    assert not session.dialogs
    assert gamma(session) == 9.0
    assert not session.finished


def test_without_changes_nothing_is_asked(session: Session, preset: Path) -> None:
    session.apply([Open(preset), New(), Open(preset), Quit()])
    assert not session.dialogs
    assert session.finished


def answered(session: Session, answer: Choice) -> None:
    session.apply([Answer(answer)])


def test_leaving_without_saving(session: Session, preset: Path) -> None:
    drag(session, 9.0)
    session.apply([Open(preset)])
    answered(session, "discard")
    assert session.document.path == preset
    assert not session.history.dirty


def test_leaving_after_saving_asks_where_and_then_goes_on(session: Session, preset: Path, tmp_path: Path) -> None:
    drag(session, 9.0)
    session.apply([Open(preset)])
    answered(session, "save")
    assert isinstance(session.dialogs[-1], ChooseFile)
    session.apply([Answer(tmp_path / "kept.json")])
    assert session.document.path == preset
    assert files.load(tmp_path / "kept.json").shapes[0].strips[0].gamma == 9.0


def test_cancelling_the_save_cancels_the_leaving(session: Session) -> None:
    drag(session, 9.0)
    session.apply([Quit()])
    answered(session, "save")
    session.apply([Answer(None)])
    assert not session.finished
    session.apply([Do("save as"), Answer(None)])
    assert not session.finished
    assert gamma(session) == 9.0


def test_when_saving_fails_nothing_is_left(session: Session, tmp_path: Path) -> None:
    drag(session, 9.0)
    session.apply([Quit()])
    answered(session, "save")
    session.apply([Answer(tmp_path / "no such folder" / "mine.json")])
    assert not session.finished
    assert session.dialogs[-1].__class__ is Problem
    assert session.history.dirty


@pytest.mark.parametrize(
    "content", [b"", b"{", b"\xff\xfe\x00", b'{"format": "hqmodel", "version": 1, "shapes": [{"strips": []}]}']
)
def test_a_damaged_file_is_told_of_and_nothing_is_lost(session: Session, tmp_path: Path, content: bytes) -> None:
    drag(session, 9.0)
    before = session.scene
    path = tmp_path / "damaged.json"
    path.write_bytes(content)
    session.apply([Open(path)])
    answered(session, "discard")
    problem = session.dialogs[-1]
    assert isinstance(problem, Problem)
    assert problem.lines
    assert all(line.startswith(f"{path}: ") for line in problem.lines)
    assert session.scene is before
    assert session.history.can_undo


def test_a_recent_file_that_has_gone_is_forgotten(session: Session, preset: Path) -> None:
    session.apply([Open(preset), New()])
    assert list(session.settings.recent) == [str(preset)]
    preset.unlink()
    session.apply([Open(preset)])
    assert isinstance(session.dialogs[-1], Problem)
    assert list(session.settings.recent) == []


def test_dialogs_are_a_stack(session: Session, tmp_path: Path) -> None:
    session.apply([Do("open")])
    asked = session.dialogs[-1]
    assert isinstance(asked, ChooseFile)
    changed = ChooseFile("open", tmp_path, "x.json")
    session.apply([Adjust(changed), Ask(Problem("Told", ("line",)))])
    assert session.dialogs == [changed, Problem("Told", ("line",))]
    session.apply([Answer(), Answer()])
    assert session.dialogs == []


def test_selection_survives_only_what_it_points_to(session: Session, preset: Path) -> None:
    session.apply([Open(preset), Select(1, 2)])
    assert (session.selection.shapes, session.selection.strip) == ((1,), 2)
    session.apply([Do("delete")])
    assert (session.selection.shapes, session.selection.strip) == ((1,), None)
    session.apply([Select(0), Select(1, add=True), Do("delete")])
    assert session.scene.shapes == ()
    assert session.selection.shapes == ()


def test_an_edit_that_cannot_be_made_says_so(session: Session) -> None:
    session.apply([Select(0, 2), Do("delete"), Select(0, 1), Do("delete"), Select(0, 0), Do("delete")])
    assert len(session.scene.shapes[0].strips) == 1
    assert session.failed
    assert session.message == "shapes[0].strips: expected at least one strip, got []"


def test_an_edit_gets_the_scene_and_its_label_is_the_step(session: Session) -> None:
    session.apply([Edit("Rename", lambda scene: scene.changed(name="Egg"))])
    assert session.scene.name == "Egg"
    assert session.history.undo_label == "Rename"
    assert session.message == "Rename"
