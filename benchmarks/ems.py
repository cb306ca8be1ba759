"""hqmodel's fits of superquadrics beside EMS, the most robust method published for them.

    python -m benchmarks.ems FOLDER [--clouds FILE ...] [--superquadrics N] [--points N] [--json FILE]

EMS (W. Liu, Y. Wu, S. Ruan, G. Chirikjian, CVPR 2022) is on no package index: FOLDER is `Python/src` of its repository,
bmlklwx/EMS-superquadric_fitting on GitHub, and it needs numba. `--clouds` are files of points of one body: how far the points
lie from either fit, along rays to its middle, as EMS measures it. Random superquadrics are as in `benchmarks.fitting`, their
errors those of the fits against the true surface. All are shares of the diagonal.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from hqmodel.fit import fit, read
from hqmodel.model import Group, Scene, Shape, Strip, Transform, vector

from .fit_clouds import KINDS, Array, cloud, radial, radial_errors, random_superquadric

Fitter = Callable[[Array], Scene]
Row = dict[str, Any]
# The largest share of outliers that EMS is to expect: what its own script has.
_OUTLIERS = 0.2
# Exponents that presets hold.
_GAMMAS = 0.05, 1000.0


def ems(folder: Path) -> Fitter:
    """EMS from its sources, compiled; what it draws with is not needed."""
    sys.path.insert(0, str(folder))
    sys.modules["EMS.utilities"] = ModuleType("EMS.utilities")
    vars(np).setdefault("int", int)  # a name that NumPy had when EMS was written
    recovery = import_module("EMS.EMS_recovery").EMS_recovery

    def fitted(points: Array) -> Scene:
        return _scene(recovery(points, OutlierRatio=_OUTLIERS)[0])

    fitted(cloud(random_superquadric(0), "clean", 200, 1))
    return fitted


def _scene(found: Any) -> Scene:
    inner, outer = np.clip(2 / np.maximum(found.shape[::-1], 1e-9), *_GAMMAS)
    strips = [
        Strip(normal=vector(normal), half_width=half, gamma=gamma, group=group)
        for normal, half, gamma, group in zip(
            found.RotM.T, found.scale.tolist(), (inner, inner, outer), ("rim", "rim", None), strict=True
        )
    ]
    shape = Shape(strips=strips, groups={"rim": Group(gamma=outer)}, transform=Transform(translation=vector(found.translation)))
    return Scene(shapes=(shape,))


def _hqmodel(points: Array) -> Scene:
    return fit(points).scene


def _compared(name: str, points: Array, fitters: dict[str, Fitter], median: Callable[[Scene], float], table: Table) -> Row:
    """One cloud fitted by each."""
    row: Row = {"cloud": name, "points": len(points)}
    for who, fitter in fitters.items():
        started = time.perf_counter()
        scene = fitter(points)
        row[f"{who} seconds"] = time.perf_counter() - started
        row[who] = median(scene)
    table.add_row(name, str(len(points)), *[f"{100 * row[who]:.4f}  {1000 * row[f'{who} seconds']:.0f}" for who in fitters])
    return row


def main() -> int:
    """The command line above."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.ems", description="Fits of superquadrics beside EMS.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--clouds", nargs="*", type=Path, default=[], metavar="FILE")
    parser.add_argument("--superquadrics", type=int, default=6, metavar="N")
    parser.add_argument("--points", type=int, default=1000, metavar="N")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    fitters = {"hqmodel": _hqmodel, "EMS": ems(options.folder)}
    table = Table("cloud", "points", *fitters, title="median radial error, % of the diagonal; milliseconds")
    rows = []
    for path in options.clouds:
        points = read(path).points
        rows.append(_compared(path.name, points, fitters, partial(_of_points, points), table))
    for seed in range(options.superquadrics):
        truth = random_superquadric(seed)
        for kind in KINDS:
            points = cloud(truth, kind, options.points, 1)
            name = f"superquadric {seed}, {kind}"
            rows.append(_compared(name, points, fitters, partial(_of_truth, truth), table))
    Console().print(table)
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1))
    return 0


def _of_points(points: Array, found: Scene) -> float:
    return float(np.median(radial(found, points, np.array(found.shapes[0].transform.translation))))


def _of_truth(truth: Scene, found: Scene) -> float:
    return float(np.median(radial_errors(found, truth)))


if __name__ == "__main__":
    sys.exit(main())
