"""What the tests of reliability look at in samples, at length: `make reliability`, or some of it by name.

Each part prints one line of numbers, and ends with an error at the first fault. See docs/reliability.md.
"""

from __future__ import annotations

import gc
import json
import os
import random
import resource
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from time import monotonic, sleep
from typing import Any

import numpy as np

from hqmodel import files, film
from hqmodel.app.asks import ExportSettings
from hqmodel.app.export import ExportJob
from hqmodel.app.filming import FilmJob
from hqmodel.app.jobs import Job
from hqmodel.app.session import Session
from hqmodel.gpu import offscreen
from hqmodel.model import usual
from tests.app.outside import surroundings
from tests.app.tools.test_random import stirred
from tests.reliability import kills, mutants, wild
from tests.reliability.objects import alive_after

MUTANTS, SCENES, PICTURES, STOPS, GESTURES, DRAWN = 250_000, 3000, 200, 12, 2000, 200


def killed() -> object:
    """Saves and exports killed at every system call."""
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    with TemporaryDirectory() as folder:
        return kills.main(Path(folder), 1, list(kills.WORKS))


def damaged() -> object:
    """Damaged presets."""
    return mutants.main(MUTANTS, 1)


def numbers() -> object:
    """Random scenes over the whole permitted range."""
    return wild.main(SCENES, 10_000, PICTURES)


def stopped() -> object:
    """Work in the background stopped at random moments: seconds until it has."""
    with TemporaryDirectory() as folder:
        return {name: _stopped(name, Path(folder)) for name in WORKS}


def _stopped(name: str, folder: Path) -> dict[str, float]:
    """The median and the longest; nothing is written, as the work is always stopped before it could be done."""
    moments, took = random.Random(1), []
    started = monotonic()
    WORKS[name](folder).wait()
    whole = monotonic() - started
    for file in folder.iterdir():
        file.unlink()
    for _ in range(STOPS):
        job = WORKS[name](folder)
        sleep(moments.uniform(0, 0.9 * whole))
        asked = monotonic()
        job.cancel()
        job.wait()
        took.append(monotonic() - asked)
        assert job.outcome is None or job.progress == 1
        assert not list(folder.iterdir()) or job.progress == 1
        for file in folder.iterdir():
            file.unlink()
    return {"median": round(sorted(took)[STOPS // 2], 3), "longest": round(max(took), 3)}


def _exporting(preset: str, suffix: str, **how: Any) -> Callable[[Path], ExportJob]:
    return lambda folder: ExportJob(files.load(preset), ExportSettings((folder / preset).with_suffix(suffix), **how))


def _filming(folder: Path) -> FilmJob:
    scene = files.load("soft-die")
    return FilmJob(film.Plan(scene, usual(scene.dimension), None, True, 12, 1.0, (320, 240)), folder / "die.gif")


WORKS: dict[str, Callable[[Path], Job[Any]]] = {
    "soft-die .stl": _exporting("soft-die", ".stl"),
    "soft-die .3mf": _exporting("soft-die", ".3mf"),
    "owl .glb": _exporting("owl", ".glb"),
    "owl of 50,000 triangles .obj": _exporting("owl", ".obj", target_faces=50_000),
    "film of soft-die": _filming,
}


def soaked() -> object:
    """Random gestures, edits and undos in one session: memory in MiB after each quarter."""
    chance, session, sizes = np.random.default_rng(11), Session(files.Settings()), []
    for number in range(1, GESTURES + 1):
        stirred(session, chance, ["rounder", "carve", "duplicate", "undo", "redo"])
        if number % (GESTURES // 4) == 0:
            sizes.append(_resident())
    return {"gestures": GESTURES, "steps kept": len(session.history.labels), "MiB": sizes}


def stirred_window() -> object:
    """Random gestures by the mouse and the keys in the real window: every 25 of them saved, reloaded and seen again."""
    return _in_a_window("tests.app.stirring:long", "stirred.json")


def sculpted() -> object:
    """An hour of sculpting in the real window: memory, frames and OpenGL's objects at first and after each quarter."""
    return _in_a_window("tests.reliability.soak:hour", "hour.json")


def _in_a_window(function: str, told: str) -> object:
    """What a function that drives the window writes to a file of that name."""
    with TemporaryDirectory() as folder:
        window = [sys.executable, "-m", "tests.app.drive", function, folder]
        screen = ["xvfb-run", "-a", "-s", "-screen 0 1280x800x24"]
        subprocess.run([*screen, *window], env=surroundings("", Path(folder)), stdout=subprocess.DEVNULL, check=True)
        return json.loads(Path(folder, told).read_text())


def _resident() -> int:
    gc.collect()
    return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize() >> 20


def drawn() -> object:
    """Many scenes in one preview, its size changing: OpenGL's objects after each quarter."""
    return alive_after(offscreen(), DRAWN)


PARTS: dict[str, Callable[[], object]] = {
    part.__name__: part for part in (killed, damaged, numbers, stopped, soaked, stirred_window, sculpted, drawn)
}

if __name__ == "__main__":
    for name in sys.argv[1:] or PARTS:
        print(f"{name}: {PARTS[name]()}", flush=True)
