"""Two dimensions in the real window. Each function is one visit, in a process of its own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from hqmodel import files
from hqmodel.app.asks import Open
from hqmodel.app.intents import Do, Look
from hqmodel.model import Camera

from .drive import Hands
from .scenarios_hands import aim, drag, once, planes, point_at, under

LANDSCAPE = "//Landscape/**/"


def the_landscape(hands: Hands) -> None:
    """The panel says when there is none; the level plane is dragged by its knob, as one step; a drag beside it turns the land."""
    session = hands.session
    hands.menu("View/Panels/###panel Landscape")
    hands.settle(3)
    hands.shoot("solid")
    assert hands.window.ground.land is None, "a solid scene has none"
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


def a_line_is_dragged(hands: Hands) -> None:
    """The bands of the strips are shown on demand; a bounding line follows the hand, the opposite one stays, in one step."""
    session = hands.session
    session.apply([Do("bands")])
    assert not session.view.bands, "a solid scene has none"
    session.apply([Open(files.find("fig05-bounding-triangle")), Look(Camera(orthographic=True).looking("top"))])
    session.frame(session.region)
    session.apply([Look(replace(session.view.camera, distance=2 * session.view.camera.distance))])
    hands.settle(3)
    hands.shoot("plain")
    hands.menu("View/###bands")
    assert session.view.bands
    hands.shoot("bands")
    before = session.scene
    below = np.array([-0.2, 0.01, 0.0])  # just above the line y = 0
    point_at(hands, below)
    strip = under(hands)
    assert strip is not None
    assert planes(before, strip)[0] == 2.0
    drag(hands, (0, 20), (0, 20))
    hands.shoot("dragged")
    far, near = planes(session.scene, strip)
    assert far == pytest.approx(2.0)
    assert near == pytest.approx(-40 * aim(hands).per_pixel(below), rel=0.05)
    once(hands, "Push plane", before)
