"""Undo and redo: exact whatever was done, and one step a drag."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

from hqmodel.edit import (
    PRIMITIVES,
    EditError,
    History,
    add_shape,
    add_strip,
    duplicate_shape,
    move_shape,
    new_scene,
    new_shape,
    put,
    remove_shapes,
    remove_strip,
    set_group,
    ungroup,
)
from hqmodel.files import dumps
from hqmodel.model import Scene, Strip
from tests.strategies import scenes

BALL = new_scene()
INDEX = st.integers(0, 3)

Edit = Callable[[Scene], Scene]
EDITS: st.SearchStrategy[Edit] = st.one_of(
    st.builds(lambda g: lambda s: put(s, "gamma", g), st.floats(0.05, 1000)),
    st.builds(lambda i, j, w: lambda s: put(s, ("shapes", i, "strips", j, "half_width"), w), INDEX, INDEX, st.floats(0.1, 5)),
    st.builds(lambda kind: lambda s: add_shape(s, new_shape(kind, s.dimension)), st.sampled_from(PRIMITIVES)),
    st.builds(lambda i: lambda s: remove_shapes(s, [i]), INDEX),
    st.builds(lambda i: lambda s: duplicate_shape(s, i), INDEX),
    st.builds(lambda i, j: lambda s: move_shape(s, i, j), INDEX, INDEX),
    st.builds(lambda i, x: lambda s: add_strip(s, i, Strip(normal=(x, 1.0, 0.0))), INDEX, st.floats(-1, 1)),
    st.builds(lambda i, j: lambda s: remove_strip(s, i, j), INDEX, INDEX),
    st.builds(lambda i, j, k: lambda s: set_group(s, i, sorted({j, k})), INDEX, INDEX, INDEX),
    st.builds(lambda i, j: lambda s: ungroup(s, i, [j]), INDEX, INDEX),
)


def attempted(edit: Edit, scene: Scene) -> Scene:
    """The edit's result, or the scene itself where it can't be made."""
    try:
        return edit(scene)
    except EditError:
        return scene


@given(scenes(), st.lists(EDITS, max_size=12))
def test_all_undone_gives_the_first_scene_and_all_redone_the_last(first: Scene, edits: list[Edit]) -> None:
    history = History(first)
    for edit in edits:
        history.apply(attempted(edit, history.present), "edit")
    last = history.present
    while history.can_undo:
        history.undo()
    assert history.present is first
    assert dumps(history.present) == dumps(first)
    while history.can_redo:
        history.redo()
    assert history.present is last


class Editing(RuleBasedStateMachine):
    """Steps, drags, undo, redo and saves in any order, against a plain list of scenes."""

    def __init__(self) -> None:
        super().__init__()
        self.history = History(BALL)
        self.scenes = [BALL]
        self.at = 0
        self.saved = BALL
        self.dragged: Scene | None = None

    def _end_drag(self) -> None:
        if self.dragged is not None and self.dragged != self.scenes[self.at]:
            self._step(self.dragged)
        self.dragged = None

    def _step(self, scene: Scene) -> None:
        self.scenes[self.at + 1 :] = [scene]
        self.at += 1

    @rule(edit=EDITS)
    def apply(self, edit: Edit) -> None:
        self._end_drag()
        scene = attempted(edit, self.scenes[self.at])
        self.history.apply(scene, "step")
        if scene != self.scenes[self.at]:
            self._step(scene)

    @rule()
    def begin(self) -> None:
        self.history.begin("drag")
        self._end_drag()
        self.dragged = self.scenes[self.at]

    @rule(edit=EDITS)
    def preview(self, edit: Edit) -> None:
        if self.dragged is None:
            with pytest.raises(RuntimeError):
                self.history.preview(self.history.present)
        else:
            self.dragged = attempted(edit, self.dragged)
            self.history.preview(self.dragged)

    @rule()
    def commit(self) -> None:
        self.history.commit()
        self._end_drag()

    @rule()
    def cancel(self) -> None:
        self.history.cancel()
        self.dragged = None

    @rule()
    def undo(self) -> None:
        shown = self.history.undo()
        if self.dragged is not None:
            self.dragged = None
        else:
            self.at = max(0, self.at - 1)
        assert shown is self.history.present

    @rule()
    def redo(self) -> None:
        shown = self.history.redo()
        if self.dragged is None:
            self.at = min(len(self.scenes) - 1, self.at + 1)
        assert shown is self.history.present

    @rule()
    def save(self) -> None:
        self.history.mark_saved()
        self.saved = self.history.present

    @invariant()
    def agrees(self) -> None:
        dragging = self.dragged is not None
        assert self.history.present == (self.scenes[self.at] if self.dragged is None else self.dragged)
        assert self.history.dragging == dragging
        assert self.history.can_undo == (dragging or self.at > 0)
        assert self.history.can_redo == (not dragging and self.at < len(self.scenes) - 1)
        assert self.history.dirty == (self.history.present != self.saved)
        assert len(self.history.labels) == self.at


TestEditing = Editing.TestCase


def test_labels_name_what_undo_and_redo_would_do() -> None:
    history = History(BALL)
    assert (history.undo_label, history.redo_label) == ("", "")
    history.apply(put(BALL, "gamma", 3), "Exponent")
    history.begin("Slice")
    assert history.undo_label == "Slice"
    history.preview(put(history.present, "slice", 0.1))
    history.commit()
    assert history.labels == ["Exponent", "Slice"]
    history.undo()
    assert (history.undo_label, history.redo_label) == ("Exponent", "Slice")


def test_a_drag_that_comes_back_is_no_step() -> None:
    history = History(BALL)
    history.begin("drag")
    history.preview(put(BALL, "gamma", 3))
    history.preview(put(BALL, "gamma", 2))
    history.commit()
    assert not history.can_undo
    assert not history.dirty


def test_recovered_work_is_unsaved_though_nothing_was_done() -> None:
    history = History(BALL)
    history.mark_unsaved()
    assert history.dirty
