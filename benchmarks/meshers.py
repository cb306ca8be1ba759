"""hqmodel's export against other meshers: time and peak memory on the same functions, side by side in one run.

    python -m benchmarks.meshers [--cells 128 256 512] [--repeat N] [--large] [--json FILE]

Every mesher works with cells of the same size, 3 / cells. Each measurement is a process of its own; peak memory is the
process's, less what it holds after its imports and a small first mesh. Of repeated measurements the quickest counts. `--large`
measures hqmodel alone up to 1024 cells and how its time grows. `pip install -e ".[bench]"` brings the other programs.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import resource
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from .rivals import ABSENT, MESHERS
from .shapes import shapes

Measured = dict[str, Any]
OURS = "hqmodel"
LARGE = [256, 512, 1024]
_WARM_UP = 32
_SECONDS = 600


def measured(method: str, shape: str, cells: int, repeat: int = 1) -> Measured:
    """The quickest of some measurements: seconds, mebibytes, faces; or only why there is none."""
    runs = [_run(method, shape, cells) for _ in range(repeat)]
    return min(runs, key=lambda run: float(run.get("seconds", np.inf)))


def _run(method: str, shape: str, cells: int) -> Measured:
    command = [sys.executable, "-m", "benchmarks.meshers", "--one", method, shape, str(cells)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=_SECONDS)
    except subprocess.TimeoutExpired:
        return {"none": f"over {_SECONDS} s"}
    if done.returncode:
        return {"none": (done.stderr.strip().splitlines() or [f"exit {done.returncode}"])[-1]}
    return dict(json.loads(done.stdout))


def _measure(method: str, shape: str, cells: int) -> None:
    """In a process of its own: one measurement, printed as JSON."""
    scene, mesher = shapes()[shape], MESHERS[method]
    mesher(scene, _WARM_UP)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.perf_counter()
    faces = len(mesher(scene, cells)[1])
    seconds = time.perf_counter() - start
    peak = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
    print(json.dumps({"seconds": seconds, "mebibytes": peak, "faces": faces}))


def compare(console: Console, cells: int, repeat: int) -> list[Measured]:
    """Run and print every mesher on every shape at one number of cells."""
    table = Table("seconds / MiB", *shapes(), title=f"{cells} cells")
    found: dict[str, dict[str, Measured]] = {}
    for method in MESHERS:
        with console.status(f"{method}, {cells} cells"):
            found[method] = {shape: measured(method, shape, cells, repeat) for shape in shapes()}
        table.add_row(method, *map(_cell, found[method].values()))
    table.add_section()
    ratios = [_ratio({method: row[shape] for method, row in found.items()}) for shape in shapes()]
    table.add_row("the quickest other / hqmodel", *ratios)
    console.print(table)
    return [{"method": m, "shape": s, "cells": cells, **run} for m, row in found.items() for s, run in row.items()]


def _cell(run: Measured) -> str:
    return f"{run['seconds']:.2f} / {run['mebibytes']:.0f}" if "seconds" in run else str(run["none"])


def _ratio(runs: dict[str, Measured]) -> str:
    """How much longer the quickest other one takes, and how much more memory."""
    ours = runs[OURS]
    others = [run for name, run in runs.items() if name != OURS and "seconds" in run]
    if "seconds" not in ours or not others:
        return "-"
    best = min(others, key=lambda run: float(run["seconds"]))
    return f"{best['seconds'] / ours['seconds']:.1f}x / {best['mebibytes'] / max(ours['mebibytes'], 1):.1f}x"


def large(console: Console, repeat: int) -> list[Measured]:
    """Run and print hqmodel alone as the cells double, with the exponent that its time grows by."""
    table = Table("seconds / MiB", *[f"{cells} cells" for cells in LARGE], "time grows as cells to the", title=OURS)
    rows = []
    for shape in shapes():
        with console.status(shape):
            runs = [measured(OURS, shape, cells, repeat) for cells in LARGE]
        seconds = [float(run.get("seconds", np.nan)) for run in runs]
        slope = float(np.polyfit(np.log(LARGE), np.log(seconds), 1)[0]) if np.all(np.isfinite(seconds)) else None
        table.add_row(shape, *map(_cell, runs), "-" if slope is None else f"{slope:.2f}")
        rows += [{"method": OURS, "shape": shape, "cells": n, "slope": slope, **run} for n, run in zip(LARGE, runs, strict=True)]
    console.print(table)
    return rows


def machine() -> str:
    """What the figures were measured on, in one line."""
    lines = Path("/proc/cpuinfo").read_text().splitlines() if Path("/proc/cpuinfo").exists() else []
    names = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    processor = names[0] if names else platform.processor() or platform.machine()
    return f"{processor}, {os.cpu_count()} cores, NumPy {np.__version__}, Python {platform.python_version()}"


def main() -> None:
    """Run and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cells", type=int, nargs="+", default=[128, 256, 512], help="powers of two, for isomesh's octree")
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--large", action="store_true", help="hqmodel alone, up to 1024 cells")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--one", nargs=3, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.one:
        _measure(options.one[0], options.one[1], int(options.one[2]))
        return
    console = Console(width=None if sys.stdout.isatty() else 160)
    console.print(machine(), ABSENT, sep="\n")
    if options.large:
        rows = large(console, options.repeat)
    else:
        rows = [row for cells in options.cells for row in compare(console, cells, options.repeat)]
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
