"""The hands on the clay from outside: a mouse and a keyboard on the real window, and the file says what came of it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from hqmodel import edit, files
from hqmodel.app.tools.aim import Aim
from hqmodel.app.tools.handles import Handles, handles
from hqmodel.field import world_planes
from hqmodel.model import Camera, Scene

from .outside import Outside

CAMERA = Camera(distance=7.0, azimuth=25.0, elevation=25.0)
FRONT = (0.2, -1.0, 0.1)


class Clay(Outside):
    """A block in the window, saved after each gesture."""

    def __init__(self, display: str, folder: Path) -> None:
        self.preset = folder / "clay.json"
        view = {"camera": {"distance": 7.0, "azimuth": 25.0, "elevation": 25.0}}
        files.save(Scene(shapes=(edit.new_shape("block"),), view=view), self.preset)
        super().__init__(display, folder, self.preset)
        self.keys("ctrl+s")
        self.until(lambda: "mode" in files.load(self.preset).view)
        self.before = self.preset.read_bytes()

    @property
    def aim(self) -> Aim:
        return Aim(CAMERA, self.viewport[2:])

    @property
    def handles(self) -> Handles:
        """Of the second strip, which is at the front."""
        known = handles(files.load(self.preset), 0, 1, self.aim)
        assert known is not None
        return known

    def pixel(self, *point: float) -> tuple[float, float]:
        x, y = self.aim.pixel(point)
        return float(x), float(y)

    def towards(self, start: tuple[float, ...], end: tuple[float, ...]) -> tuple[float, float]:
        """Half of the way on the screen from one world point to another."""
        x, y = (self.aim.pixel(end) - self.aim.pixel(start)) / 2
        return float(x), float(y)

    def saved(self) -> bytes:
        """The file's bytes after something was changed and saved."""
        self.until(lambda: self.title() == "clay* - hqmodel")
        self.until(self._is_saved)
        return self.preset.read_bytes()

    def _is_saved(self) -> bool:
        """Saves; while a drag still goes on that does nothing."""
        self.keys("ctrl+s")
        time.sleep(0.3)
        return self.title() == "clay - hqmodel"

    def gives(self, gesture: Callable[[], None]) -> Scene:
        """The scene that a gesture makes; one undo takes it back to the last byte."""
        gesture()
        self.saved()
        after = files.load(self.preset)
        self.keys("ctrl+z")
        assert self.saved() == self.before
        time.sleep(0.5)  # a key in the same slow frame in which Ctrl was let go would count as pressed with it
        return after


@pytest.fixture
def clay(display: str, tmp_path: Path) -> Iterator[Clay]:
    window = Clay(display, tmp_path)
    try:
        yield window
    finally:
        window.end()


def planes(scene: Scene, strip: int) -> tuple[float, float]:
    normals, offsets = world_planes(scene.shapes[0], 0.0)
    length = float(np.linalg.norm(normals[strip]))
    return (1 - float(offsets[strip])) / length, (-1 - float(offsets[strip])) / length


def test_ten_gestures(clay: Clay) -> None:
    front, out = clay.pixel(*FRONT), clay.towards(FRONT, (0.2, -1.5, 0.1))

    pushed = clay.gives(lambda: clay.drag(front, out, out))
    near, far = planes(pushed, 1)
    assert near == pytest.approx(1.0, abs=1e-9), "the opposite plane stays"
    assert far == pytest.approx(-1.5, abs=0.03)

    both = clay.gives(lambda: clay.drag(front, out, out, holding=lambda: clay.keys("Tab")))
    assert planes(both, 1) == pytest.approx((1.5, -1.5), abs=0.03)

    typed = clay.gives(lambda: clay.drag(front, out, holding=lambda: clay.keys("0", "period", "2", "5", "Return")))
    assert planes(typed, 1)[1] == pytest.approx(-1.25, abs=1e-9)

    clay.drag(clay.pixel(0.5, -1.0, 0.4))  # a click selects the strip, and its handles are there
    time.sleep(0.5)
    ring = clay.handles.ring[int(np.argmin(clay.handles.ring[:, 1]))]
    tilted = clay.gives(lambda: clay.drag((float(ring[0]), float(ring[1])), (-4, 12), (-4, 12)))
    normals, _ = world_planes(tilted.shapes[0], 0.0)
    assert 0.05 < abs(normals[1][2]) < 0.9
    assert np.linalg.norm(normals[1]) == pytest.approx(1.0)

    middle = clay.handles.middle
    softer = clay.gives(lambda: clay.drag((float(middle[0]), float(middle[1])), (-30, 0), (-60, 0)))
    assert [strip.gamma < 10 for strip in softer.shapes[0].strips] == [False, True, False]

    clay.keys("2")
    press = clay.towards(FRONT, (0.2, -0.7, 0.1))
    patted = clay.gives(lambda: clay.drag(front, press, press))
    assert planes(patted, 3)[0] == pytest.approx(0.7, abs=0.05)

    clay.keys("3")
    x, y = clay.pixel(-1.5, 0.0, 0.5)
    chopped = clay.gives(lambda: clay.drag((x, y), (150, 0), (200, 0)))
    normals, _ = world_planes(chopped.shapes[0], 0.0)
    assert normals[3][2] / np.linalg.norm(normals[3]) > 0.8

    clay.keys("1")
    clay.tool("mousemove", str(round(clay.viewport[0] + front[0])), str(round(clay.viewport[1] + front[1])))
    moved = clay.gives(lambda: clay.keys("g", "x", "1", "period", "5", "Return"))
    assert moved.shapes[0].transform.translation == (1.5, 0, 0)
    turned = clay.gives(lambda: clay.keys("r", "z", "3", "0", "Return"))
    assert edit.angles(turned.shapes[0].transform.rotation) == pytest.approx((0, 0, 30))
    scaled = clay.gives(lambda: clay.keys("s", "2", "Return"))
    assert scaled.shapes[0].transform.scale == (2, 2, 2)
