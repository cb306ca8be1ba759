"""How many frames a second the window draws while a slider is dragged, with the body and with an empty viewport, side by side.

    xvfb-run -a -s "-screen 0 1600x1000x24" python -m benchmarks.dragging [--size 1600x1000] [--seconds 5] [PRESET ...]

The real window on the display there is; frames are those it has drawn while the mouse moves.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from imgui_bundle import imgui
from rich.console import Console
from rich.table import Table

from hqmodel.app import asks
from hqmodel.files import load, save
from tests.app import drive

from .meshers import machine

PRESETS = ["soft-die", "owl", "mug", "cottage"]
_SLIDER = "//Properties/**/##shapes[0].hardness"
_REACH = 30.0
_FOUND: list[tuple[float, float]] = []
_TIMES: list[float] = []


def frames_a_second(hands: drive.Hands, seconds: float) -> float:
    """The rate while the slider is dragged to and fro."""
    ctx = hands.ctx
    ctx.mouse_move(_SLIDER)
    start = imgui.get_mouse_pos()
    ctx.mouse_down()
    began, first = perf_counter(), imgui.get_frame_count()
    while (past := perf_counter() - began) < seconds:
        share = past / seconds * 4 % 2
        ctx.mouse_move_to_pos((start.x + _REACH * min(share, 2 - share), start.y))
    rate = (imgui.get_frame_count() - first) / (perf_counter() - began)
    ctx.mouse_up()
    hands.settle(10)
    return rate


def measure(hands: drive.Hands) -> None:
    """Both rates for the scene that is open, in turn and twice; the better of each counts."""
    seconds, scene = _TIMES[0], hands.session.scene
    hidden = [shape.model_copy(update={"visible": False}) for shape in scene.shapes]
    empty = scene.model_copy(update={"shapes": tuple(hidden)})
    with_body, without = list[float](), list[float]()
    for _ in range(2):
        for rates, shown in ((with_body, scene), (without, empty)):
            path = hands.folder / "shown.json"
            save(shown, path)
            hands.session.apply([asks.Open(path)])
            hands.settle(60)
            rates.append(frames_a_second(hands, seconds))
            hands.session.history.mark_saved()
    _FOUND.append((max(with_body), max(without)))


def main() -> None:
    """Run and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("presets", nargs="*", default=PRESETS)
    parser.add_argument("--size", default="1600x1000")
    parser.add_argument("--seconds", type=float, default=5.0)
    options = parser.parse_args()
    width, height = map(int, options.size.split("x"))
    drive.SIZE = width, height
    _TIMES.append(options.seconds)
    console = Console(width=100)
    table = Table("preset", "shapes", "frames/s, empty", "frames/s, body", "share", title=f"dragging a slider at {options.size}")
    print(machine())
    for name in options.presets:
        scene = load(name)
        with TemporaryDirectory() as folder:
            path = Path(folder) / "begin.json"
            save(scene, path)
            if drive.main("benchmarks.dragging:measure", Path(folder), path):
                sys.exit(1)
        body, empty = sys.modules["benchmarks.dragging"]._FOUND.pop()
        table.add_row(name, str(len(scene.shapes)), f"{empty:.1f}", f"{body:.1f}", f"{body / empty:.0%}")
    console.print(table)


if __name__ == "__main__":
    from benchmarks import dragging  # the module that `drive` imports, not a second one

    dragging.main()
