"""What moves by itself in the real window. Each function is one visit, in a process of its own."""

from __future__ import annotations

from imgui_bundle import imgui

from hqmodel import edit, files
from hqmodel.app.asks import Filmed, Open
from hqmodel.app.intents import Edit
from hqmodel.model import Scene

from .drive import Hands
from .scenarios import PROPERTIES

TIMELINE = "//Timeline/**/"


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


def the_timeline(hands: Hands) -> None:
    """A right click sets a number in motion; it plays, is scrubbed, changed, undone; a fault is told and can be removed."""
    session = hands.session
    for slider in ("shapes[0].strips[0].gamma", "shapes[0].hardness"):
        hands.ctx.item_click(f"{PROPERTIES}##{slider}", imgui.MouseButton_.right)
        hands.click("//$FOCUSED/Animate...")
    hands.settle(5)
    assert session.history.labels == ["Animate Exponent", "Animate Hardness"]
    (animation,) = edit.animations(session.scene)
    assert [sweep.path for sweep in animation.sweeps] == ["shapes[0].strips[0].gamma", "shapes[0].hardness"]
    hands.click(f"{TIMELINE}Turntable")
    hands.settle(3)
    hands.click(f"{TIMELINE}$$0/###play")
    hands.wait(lambda: gamma(session.shown) > 3.0)
    assert gamma(session.scene) == 2.0
    hands.shoot("timeline")
    hands.click(f"{TIMELINE}###stop")
    assert session.shown is session.scene
    hands.drag(f"{TIMELINE}##scrub", 100)
    assert gamma(session.shown) > 2.0
    hands.type_value(f"{TIMELINE}$$0/##1", 5.0)
    assert edit.animations(session.scene)[0].sweeps[0].values == (2.0, 5.0)
    hands.type_value(f"{TIMELINE}$$0/##1", -1.0)
    assert session.message == "sweeps[0].values[1]: expected a number from 0.05 to 1000, got -1"
    hands.type_value(f"{TIMELINE}$$0/##duration", 7.5)
    assert edit.animations(session.scene)[0].duration == 7.5
    hands.click(f"{TIMELINE}$$1/###play")
    hands.wait(lambda: session.shown_view.camera.azimuth != session.view.camera.azimuth)
    hands.click(f"{TIMELINE}$$1/###remove")
    assert session.player.animation is None
    assert len(session.scene.animations) == 1
    session.apply([Edit("Spoil", lambda scene: scene.changed(animations=({"sweeps": []},)))])
    hands.settle(3)
    hands.shoot("timeline-fault")
    hands.click(f"{TIMELINE}$$0/###remove")
    assert not session.scene.animations


def a_film_of_it(hands: Hands) -> None:
    """The timeline's own export: the dialog, a film in the background, and one that is stopped."""
    session, dialog = hands.session, "//Export Animation"
    hands.ctx.item_click(f"{PROPERTIES}##shapes[0].strips[0].gamma", imgui.MouseButton_.right)
    hands.click("//$FOCUSED/Animate...")
    for name in ("stopped", "kept"):
        hands.click(f"{TIMELINE}Export...")
        hands.type_value(f"{dialog}/##file", str(hands.folder / f"{name}.gif"))
        hands.type_value(f"{dialog}/##seconds", 0.2 if name == "kept" else 60.0)
        hands.type_value(f"{dialog}/##fps", 20)
        hands.type_value(f"{dialog}/##pixels/$$0", 80)
        hands.type_value(f"{dialog}/##pixels/$$1", 60)
        hands.shoot("film")
        hands.click(f"{dialog}/Export")
        assert session.job is not None
        if name == "stopped":
            hands.click("//StatusBar/Stop")
        hands.wait(lambda: session.job is None, 3000)
    told = session.dialogs[-1]
    assert isinstance(told, Filmed), told
    assert told.told == "4 frames, 0.2 s, 80 x 60 pixels"
    hands.shoot("filmed")
    hands.click("//Exported/OK")
    assert [path.name for path in hands.folder.glob("*.gif")] == ["kept.gif"]


def gamma(scene: Scene) -> float:
    return scene.shapes[0].strips[0].gamma
