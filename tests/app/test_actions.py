"""The table of actions: complete, without clashes, and each does what its label says."""

from __future__ import annotations

from collections import Counter

import pytest

from hqmodel import files
from hqmodel.app.actions import ACTIONS, HIDDEN, MENUS, RECENT, Entry
from hqmodel.app.asks import About, ChooseFile, ExportAs, Problem, Shortcuts
from hqmodel.app.intents import Do, Put, Select
from hqmodel.app.preferences import THEMES
from hqmodel.app.session import Session
from hqmodel.model import VIEWS


@pytest.fixture
def session() -> Session:
    return Session(files.Settings())


def names(entries: tuple[Entry, ...]) -> list[str]:
    flat: list[str] = []
    for entry in entries:
        if isinstance(entry, tuple):
            flat += entry[1]
        elif entry is not None and entry != RECENT:
            flat.append(entry)
    return flat


def shapes(session: Session) -> list[str]:
    return [shape.name for shape in session.scene.shapes]


def test_every_action_is_in_a_menu_once_and_every_entry_is_an_action() -> None:
    listed = Counter(name for entries in MENUS.values() for name in names(entries))
    assert set(listed) == set(ACTIONS)
    assert set(listed.values()) == {1}


def test_no_two_actions_share_a_shortcut() -> None:
    keys = Counter(keys for action in ACTIONS.values() for keys in action.shortcuts)
    assert set(keys.values()) == {1}


def test_the_expected_shortcuts_are_there() -> None:
    wanted = {
        "undo": "Ctrl+Z", "redo": "Ctrl+Shift+Z", "save": "Ctrl+S", "save as": "Ctrl+Shift+S", "open": "Ctrl+O", "new": "Ctrl+N",
        "export": "Ctrl+E", "duplicate": "Ctrl+D", "delete": "Del", "frame selected": "F", "frame all": "Home",
        "view front": "Num 1", "view right": "Num 3", "view top": "Num 7",
    }  # fmt: skip
    assert all(keys in ACTIONS[name].shortcuts for name, keys in wanted.items())
    assert "Ctrl+Y" in ACTIONS["redo"].shortcuts
    assert "X" in ACTIONS["delete"].shortcuts


def test_an_action_that_cannot_be_done_does_nothing(session: Session) -> None:
    before = session.scene
    session.apply([Select(None), Do("undo"), Do("redo"), Do("delete"), Do("duplicate"), Do("add strip"), Do("stop export")])
    assert session.scene is before


@pytest.mark.parametrize("kind", ["ball", "block", "cylinder"])
def test_a_shape_is_added_and_selected(session: Session, kind: str) -> None:
    session.apply([Do(f"add {kind}")])
    assert len(session.scene.shapes) == 2
    assert session.selection.shapes == (1,)
    assert session.history.undo_label == f"Add {kind}"


def test_a_shape_can_be_added_to_a_flat_scene(session: Session) -> None:
    session.apply([Select(0, 2), Do("delete"), Put(("dimension",), 2, "Dimension"), Do("add cylinder")])
    assert shapes(session) == ["Ball", "Cylinder"]


def test_shapes_are_duplicated_moved_and_deleted(session: Session) -> None:
    session.apply([Do("add block"), Do("duplicate")])
    assert shapes(session) == ["Ball", "Block", "Block 2"]
    assert session.selection.active == 2
    session.apply([Do("move up"), Do("move up"), Do("move up")])
    assert shapes(session) == ["Block 2", "Ball", "Block"]
    assert session.selection.active == 0
    session.apply([Do("move down"), Do("delete")])
    assert shapes(session) == ["Ball", "Block"]
    assert session.selection.active is None


def test_several_shapes_are_duplicated_at_once(session: Session) -> None:
    session.apply([Do("add block"), Select(0, add=True), Do("duplicate")])
    assert shapes(session) == ["Ball", "Ball 2", "Block", "Block 2"]
    assert session.history.labels == ["Add block", "Duplicate"]


def test_strips_are_added_duplicated_moved_and_deleted(session: Session) -> None:
    session.apply([Do("add strip")])
    assert (session.selection.active, session.selection.strip) == (0, 3)
    session.apply([Do("duplicate"), Do("move up"), Do("move up")])
    assert session.selection.strip == 2
    assert [strip.normal[2] for strip in session.scene.shapes[0].strips] == [0, 0, 0, 1, 0]
    session.apply([Do("delete")])
    assert len(session.scene.shapes[0].strips) == 4


def test_views_keep_their_distance_and_projection_switches(session: Session) -> None:
    before = session.view.camera
    for name, angles in VIEWS.items():
        session.apply([Do(f"view {name}")])
        camera = session.view.camera
        assert (camera.azimuth, camera.elevation) == angles
        assert camera.distance == before.distance
    session.apply([Do("orthographic")])
    assert session.view.camera.orthographic
    assert ACTIONS["orthographic"].checked is not None
    assert ACTIONS["orthographic"].checked(session)


def test_framing_shows_what_is_selected_hidden_or_not(session: Session) -> None:
    session.apply([Do("add ball"), Put(("shapes", 1, "transform", "translation"), (9.0, 0.0, 0.0), "Position")])
    session.apply([Put(("shapes", 1, "visible"), False, "Hide"), Do("frame selected")])
    assert session.view.camera.target[0] == pytest.approx(9.0, abs=0.1)
    session.apply([Select(None), Do("frame selected")])
    assert session.view.camera.target[0] == pytest.approx(0.0, abs=0.1)
    session.apply([Put(("shapes", 1, "visible"), True, "Show"), Do("frame all")])
    assert session.view.camera.target[0] == pytest.approx(4.5, abs=0.2)


def test_modes_and_themes_are_checked_one_at_a_time(session: Session) -> None:
    session.apply([Do("mode depth"), Do("theme light"), Do("grid 0.25")])
    for prefix, chosen in (("mode", "depth"), ("theme", "light"), ("grid", "0.25")):
        actions = {name: action for name, action in ACTIONS.items() if name.startswith(f"{prefix} ")}
        assert [name for name, action in actions.items() if action.checked and action.checked(session)] == [f"{prefix} {chosen}"]
    assert files.Settings.read().preferences["theme"] == "light"


def test_the_grid_is_shown_and_its_step_chosen(session: Session) -> None:
    assert (session.preferences.grid, session.preferences.grid_step) == (False, None)
    session.apply([Do("grid"), Do("grid 0.5")])
    kept = Session(files.Settings.read()).preferences
    assert (kept.grid, kept.grid_step) == (True, 0.5)
    session.apply([Do("grid auto")])
    assert session.preferences.grid_step is None


def test_an_unknown_theme_in_the_settings_is_the_first_one() -> None:
    assert Session(files.Settings(preferences={"theme": "plaid"})).preferences.theme == THEMES[0]


def test_panels_hide_and_come_back(session: Session) -> None:
    session.apply([Do("panel Scene"), Do("panel Outliner")])
    assert session.hidden_panels == {"Scene", "Outliner", *HIDDEN}
    session.apply([Do("panel Scene"), Do("reset layout")])
    assert session.hidden_panels == set(HIDDEN)
    assert session.layout_wanted


def test_undo_and_redo_say_what(session: Session) -> None:
    session.apply([Do("add block")])
    assert ACTIONS["undo"].title(session) == "Undo Add block"
    session.apply([Do("undo")])
    assert ACTIONS["undo"].title(session) == "Undo"
    assert ACTIONS["redo"].title(session) == "Redo Add block"


@pytest.mark.parametrize(
    ("name", "dialog"),
    [("open", ChooseFile), ("save as", ChooseFile), ("export", ExportAs), ("shortcuts", Shortcuts), ("about", About)],
)
def test_what_needs_an_answer_opens_a_dialog(session: Session, name: str, dialog: type) -> None:
    session.apply([Do(name)])
    assert [type(open_dialog) for open_dialog in session.dialogs] == [dialog]


def test_nothing_and_the_endless_are_not_exported(session: Session) -> None:
    session.apply([Put(("shapes", 0, "strips", 2, "sign"), -1, "Sign"), Do("export")])
    problem = session.dialogs.pop()
    assert isinstance(problem, Problem)
    assert "without end" in problem.lines[0]
    session.apply([Select(0), Do("delete"), Do("export")])
    problem = session.dialogs.pop()
    assert isinstance(problem, Problem)
    assert "no body" in problem.lines[0]
