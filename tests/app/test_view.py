"""How a preset remembers what it was seen from."""

from __future__ import annotations

from typing import Any

import pytest

from hqmodel.app.view import MODES, View, restored
from hqmodel.gpu import MODES as DRAWN
from hqmodel.model import Camera

VIEW = View(Camera((1.0, 2.0, 3.0), 4.0, 50.0, -60.0, 35.0, True), "depth")


def test_the_modes_are_those_that_can_be_drawn() -> None:
    assert MODES == DRAWN


def test_a_view_comes_back_and_what_others_keep_there_stays() -> None:
    stored = VIEW.stored({"grid": True, "mode": "clay"})
    assert stored["grid"] is True
    assert restored(stored) == VIEW


def test_what_is_not_said_is_as_usual() -> None:
    assert restored({"camera": {"distance": 9.0}}) == View(Camera(distance=9.0))
    assert restored({"camera": {}, "mode": "plaid"}) == View()


@pytest.mark.parametrize(
    "camera",
    [
        None,
        "front",
        {"distance": 0.0},
        {"distance": -1.0},
        {"distance": float("nan")},
        {"distance": "near"},
        {"distance": True},
        {"elevation": 91.0},
        {"field_of_view": 180.0},
        {"target": [0.0, 0.0]},
        {"target": "origin"},
        {"target": [0.0, 0.0, float("inf")]},
    ],
)
def test_what_cannot_be_used_is_not(camera: Any) -> None:
    assert restored({"camera": camera}) is None


def test_no_view_is_none() -> None:
    assert restored({}) is None
