"""Two dimensions in the real window. Each function is one visit, in a process of its own."""

from __future__ import annotations

from hqmodel import files
from hqmodel.app.asks import Open
from hqmodel.app.intents import Do

from .drive import Hands

LANDSCAPE = "//Landscape/**/"


def the_landscape(hands: Hands) -> None:
    """The panel says when there is none; the level plane is dragged by its knob, as one step; a drag beside it turns the land."""
    session = hands.session
    hands.menu("View/Panels/###panel Landscape")
    hands.settle(3)
    hands.shoot("solid")
    session.hidden_panels |= {"Properties", "Scene"}
    session.apply([Open(files.find("fig17-two-hills"))])
    hands.settle(3)
    before, land = session.scene, hands.window.ground.land
    assert land is not None
    hands.shoot("land")
    hands.drag(f"{LANDSCAPE}##knob", 0, -30)
    assert before.level < session.scene.level < 1.1
    assert session.history.labels == ["Level w"]
    assert hands.window.ground.land is land, "the level changes nothing of the land"
    hands.shoot("higher")
    azimuth = hands.window.ground.azimuth
    hands.drag(f"{LANDSCAPE}##turn", 40, 20)
    assert hands.window.ground.azimuth != azimuth
    hands.shoot("turned")
    session.apply([Do("undo")])
    assert session.scene == before
