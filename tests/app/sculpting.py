"""A sculpting session in the real window, photographed step by step: the README's animated picture is made of it."""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui

from hqmodel import edit
from hqmodel.app.intents import Do, Edit, Look, Select
from hqmodel.model import Camera, Scene

from .drive import Hands
from .scenarios_hands import aim, goto, move, point_at

Key = imgui.Key


class Film:
    """Takes pictures, numbered, once the viewport's own is as fine as it gets."""

    def __init__(self, hands: Hands) -> None:
        self.hands, self.count = hands, 0
        hands.session.keep(hands.session.settings.preferring(refining=True))
        hands.window.spare = lambda: 0.3  # type: ignore[method-assign]  # while a button is held, too

    def shot(self) -> None:
        canvas = self.hands.window.canvas
        self.hands.settle(3)
        self.hands.wait(lambda: not canvas.unfinished, 4000)
        self.hands.shoot(f"film-{self.count:02d}")
        self.count += 1


def session(hands: Hands) -> None:
    """A block is patted, rounded, chopped and given a head."""
    film, scene = Film(hands), Scene(shapes=(edit.new_shape("block").changed(color=(0.76, 0.52, 0.38)),))
    hands.session.apply([Edit("begin", lambda _: scene), Look(Camera(distance=9.0, azimuth=30.0, elevation=22.0)), Select(None)])
    film.shot()

    point_at(hands, (0.2, -1.0, 0.1))
    film.shot()
    out = (aim(hands).pixel((0.2, -1.6, 0.1)) - aim(hands).pixel((0.2, -1.0, 0.1))) / 3
    pressed(hands, film, [out] * 3)

    hands.keys(Key._2)
    corner = np.array([0.86, -1.46, 0.86])
    point_at(hands, corner)
    pressed(hands, film, [np.array((-6.0, 14.0))] * 3)

    hands.keys(Key._4)
    point_at(hands, (0.2, -0.4, 1.0))
    pressed(hands, film, [np.array((-35.0, 0.0))] * 3)

    hands.keys(Key._3)
    goto(hands, (50, 290))
    pressed(hands, film, [np.array((100.0, 38.0))] * 3)

    hands.keys(Key._1)
    hands.session.apply([Do("add ball")])
    hands.keys(Key.g)
    hands.keys(Key.z)
    for _ in range(3):
        move(hands, (0, -22))
        film.shot()
    hands.keys(Key.enter)
    hands.session.apply([Select(0), Do("select all")])
    hands.keys(Key.h)
    move(hands, (30, 0))
    hands.keys(Key.enter)
    film.shot()


def pressed(hands: Hands, film: Film, steps: list[np.ndarray]) -> None:
    """Press, move, let go, with a picture at each step."""
    hands.ctx.mouse_down()
    hands.settle()
    for step in steps:
        move(hands, step)
        film.shot()
    hands.ctx.mouse_up()
    hands.settle()
    film.shot()
