"""An hour of sculpting in the real window, squeezed into minutes: what it takes of the machine after each quarter.

``python -m tests.app.drive tests.reliability.soak:hour FOLDER`` writes ``hour.json`` there.
"""

from __future__ import annotations

import gc
import json
import resource
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import TypeVar

import moderngl
import numpy as np

from hqmodel.app.intents import Intent, Look

from ..app.drive import Hands
from ..app.stirring import stir
from .objects import alive

T = TypeVar("T")
# One every three seconds.
GESTURES = 1200
# How many pictures are taken the time of, the view turning a little from one to the next.
FRAMES = 60


def hour(hands: Hands) -> None:
    """Four quarters of gestures, each undone at its end, so that the same can be measured after it."""
    stir(hands, 20, 20, 0)  # whatever is made at its first use is there then
    taken = [_taken(hands)]
    for quarter in range(1, 5):
        stir(hands, GESTURES // 4, 100, quarter)
        taken.append(_taken(hands))
    (hands.folder / "hour.json").write_text(json.dumps(taken))


def _taken(hands: Hands) -> dict[str, object]:
    """Memory in MiB, the median time of a frame in ms, and OpenGL's objects by kind."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    objects = _in_a_frame(hands, lambda: alive(moderngl.get_context()))
    return {"MiB": pages * resource.getpagesize() >> 20, "ms": _frame(hands), **objects._asdict()}


def _frame(hands: Hands) -> float:
    view, times = hands.session.view, []
    for number in range(FRAMES):
        began = perf_counter()
        hands.session.apply([Look(replace(view.camera, azimuth=view.camera.azimuth + number % 8))])
        hands.settle(1)
        times.append(1000 * (perf_counter() - began))
    return round(float(np.median(times)), 1)


def _in_a_frame(hands: Hands, work: Callable[[], T]) -> T:
    """What the work gives, done by the thread that draws: OpenGL is that one's."""
    panels, done = hands.window.panels, list[T]()
    panel = panels["Viewport"]

    def working() -> Iterable[Intent]:
        if not done:
            done.append(work())
        return panel()

    panels["Viewport"] = working
    hands.wait(lambda: done)
    panels["Viewport"] = panel
    return done[0]
