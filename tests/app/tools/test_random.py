"""A thousand gestures in a row, anywhere and of any kind: nothing fails, every state can be saved, and all can be undone."""

from __future__ import annotations

import json

import numpy as np
from numpy.random import Generator

from hqmodel.app import editing
from hqmodel.app.intents import Do, Drop, Equip, Pull, Release, Select, Take
from hqmodel.app.session import Session
from hqmodel.app.tools import reach
from hqmodel.app.tools.aim import Aim
from hqmodel.app.tools.gesture import Gesture, Held
from hqmodel.app.tools.grip import grip_at
from hqmodel.app.tools.handles import handles
from hqmodel.app.tools.kit import Kit
from hqmodel.field import Terms, value
from hqmodel.files import Settings
from hqmodel.files.dump import dumps
from hqmodel.model import Camera, Scene

GESTURES = 1000
TOOLS = ["faces"] * 5 + ["soften"] * 3 + ["pat", "chop"]
KEYS = ["rounder", "sharper", "carve", "duplicate", "delete", "undo", "redo", "add ball", "add prism 5"]
# Beyond so many strips some are taken away again, so that a thousand gestures stay a matter of seconds.
MOST = 24


def begun(session: Session, aim: Aim, chance: Generator) -> Gesture | None:
    """A gesture that a hand could begin just now."""
    scene, selection = session.scene, session.selection
    at = (float(chance.uniform(0, aim.size[0])), float(chance.uniform(0, aim.size[1])))
    if chance.random() < 0.25:
        return reach.modal(str(chance.choice(reach.MODAL)), scene, selection, aim, at)
    grip = grip_at(scene, chance.uniform(-1.2, 1.2, 3))
    known = None
    if selection.active is not None and selection.strip is not None:
        known = handles(scene, selection.active, selection.strip, aim)
        if known is not None and chance.random() < 0.5:
            at = (float(known.ring[5, 0]), float(known.ring[5, 1]))
    kit = Kit(str(chance.choice(TOOLS)), str(chance.choice(["one", "both", "slide"])), 12.0, 60.0)  # type: ignore[arg-type]
    session.apply([Equip(kit)])
    return reach.taken(kit, scene, selection, aim, at, grip, known)


def pulled(session: Session, gesture: Gesture, chance: Generator) -> None:
    """Pulled about, Tab pressed, numbers typed, and let go of or put back."""
    held = Held(gesture)
    session.apply([Take(gesture)])
    for _ in range(int(chance.integers(1, 4))):
        held = held.pulled(tuple(chance.uniform(-120, 120, 2)), bool(chance.random() < 0.3))
        session.apply([Pull(held)])
    if chance.random() < 0.3:
        held = Held(held.gesture.other(), held.moved, held.snap, str(chance.choice(["", "0.2", "-0.4", "-", "1e9", "0"])))
        session.apply([Pull(held)])
    session.apply([Drop() if chance.random() < 0.1 else Release()])


def stirred(session: Session, chance: Generator, keys: list[str]) -> None:
    """Something selected, and then a gesture made or one of these actions done."""
    session.apply([Select(*picked(session.scene, chance))])
    if chance.random() < 0.15 or session.scene.strip_count > MOST:
        session.apply([Do("delete" if session.scene.strip_count > MOST else str(chance.choice(keys)))])
        if not any(shape.visible and shape.coefficient > 0 for shape in session.scene.shapes):
            session.apply([Do("add block")])
        return
    camera = Camera(distance=8.0, azimuth=float(chance.uniform(0, 360)), elevation=float(chance.uniform(-80, 80)))
    gesture = begun(session, Aim(camera, (900, 700)), chance)
    if gesture is not None:
        pulled(session, gesture, chance)


def reloaded(scene: Scene) -> Scene:
    return Scene.model_validate(json.loads(dumps(scene)))


def test_a_thousand_random_gestures() -> None:
    chance = np.random.default_rng(7)
    session = Session(Settings())
    first = session.scene
    points = chance.uniform(-2, 2, (50, 3))
    for number in range(GESTURES):
        stirred(session, chance, KEYS)
        assert session.held is None
        if number % 5 == 0:
            assert reloaded(session.scene) == session.scene
            assert np.all(np.isfinite(value(Terms.of(session.scene), points)))
    assert len(session.history.labels) > GESTURES / 4
    while session.history.can_undo:
        editing.undo(session)
    assert session.scene == first


def picked(scene: Scene, chance: Generator) -> tuple[int, int]:
    """A shape and one of its strips."""
    shape = int(chance.integers(len(scene.shapes)))
    return shape, int(chance.integers(len(scene.shapes[shape].strips)))
