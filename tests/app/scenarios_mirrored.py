"""The mirror image of a shape in the real window: it is taken hold of like the shape itself."""

from __future__ import annotations

import numpy as np

from hqmodel import edit
from hqmodel.app.hands.hand import known_handles
from hqmodel.app.intents import Edit, Look, Put, Select
from hqmodel.app.tools.grip import Grip
from hqmodel.model import Camera

from .drive import Hands
from .scenarios_hands import aim, begin, drag, goto, planes, point_at

IMAGE = (-1.0, 1.0, 1.0)


def a_mirror_image_is_worked_on(hands: Hands) -> None:
    """Its face lights up and is dragged; a click on it brings its own handles, and they pull its plane."""
    session = hands.session
    begin(hands)
    moved = edit.turn_shapes(edit.move_shapes(session.scene, [0], (1.6, 0, 0)), [0], edit.about((0, 0, 1), 20), (1.6, 0, 0))
    before = edit.put(moved, "mirror", ["x"])
    session.apply([Edit("Mirror", lambda _: before), Look(Camera(distance=12, azimuth=-15, elevation=20)), Select(None)])
    hands.settle(3)
    face = Grip(0, 1, -1, (0.0, 0.0, 0.0), IMAGE).face(before)
    point_at(hands, face.middle)
    assert hands.window.hand.lit == (0, 1)
    drag(hands, *[(aim(hands).pixel(face.middle + 0.5 * face.normal) - aim(hands).pixel(face.middle)) / 2] * 2)
    near, far = planes(session.scene, 1), planes(before, 1)
    assert abs(near[0] - far[0]) < 1e-9
    assert abs(far[1] - near[1] - 0.5) < 0.03
    hands.ctx.mouse_click()
    hands.settle()
    assert (session.selection.strip, session.selection.image) == (1, IMAGE)
    known = known_handles(session, aim(hands))
    assert known is not None
    assert known.face.middle[0] < 0
    goto(hands, known.arrow.mean(axis=0))
    drag(hands, *[(known.arrow[1] - known.arrow[0]) / 2] * 2, release=False)
    hands.shoot("mirrored")
    hands.ctx.mouse_up()
    hands.settle()
    pulled = planes(session.scene, 1)
    assert abs(pulled[0] - near[0]) < 1e-9
    assert pulled[1] < near[1] - 0.1
    assert session.history.labels[-2:] == ["Push plane"] * 2
    session.apply([Put(("shapes", 0, "mirror"), (), "Mirror")])
    assert session.selection.image == (1, 1, 1), "what is gone is not selected"
    hands.settle(2)
    assert np.all(known_handles(session, aim(hands)).grip.image == np.ones(3))  # type: ignore[union-attr]
