"""What moves by itself in the real window. Each function is one visit, in a process of its own."""

from __future__ import annotations

from imgui_bundle import imgui

from hqmodel import files
from hqmodel.app.asks import Open

from .drive import Hands


def the_slice_plays(hands: Hands) -> None:
    """Play, pause, stop: the shape follows and the scene stays; taking hold of the slider ends it."""
    session, bar = hands.session, bottom()
    session.apply([Open(files.find("tetrahedral-slice"))])
    hands.settle(3)
    start = session.scene
    hands.click(f"{bar}/###play")
    hands.wait(lambda: session.shown.slice != start.slice)
    assert session.scene is start
    hands.shoot("slice")
    hands.click(f"{bar}/###play")
    paused = session.shown
    hands.settle(3)
    assert session.shown is paused
    hands.click(f"{bar}/###repeat")
    assert abs(session.shown.slice - paused.slice) < 1e-9
    hands.click(f"{bar}/###stop")
    assert session.shown is start
    assert not session.history.dirty
    hands.click(f"{bar}/###play")
    hands.drag(f"{bar}/##slice", 40)
    assert session.shown is session.scene
    assert session.history.labels == ["Slice t"]


def bottom() -> str:
    return "//" + next(window.name for window in imgui.get_current_context().windows if window.name.startswith("##Bottom"))
