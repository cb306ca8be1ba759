"""How well and how fast `hqmodel.fit` finds what is known.

    python -m benchmarks.fitting [--shapes NAME ...] [--random N] [--superquadrics N] [--points N] [--starts N]
        [--clouds FILE ...] [--parts N ...] [--json FILE]

Clouds of `--points` points of the convex reference shapes (or presets named), of `--random` random ones and of random
superquadrics, each clean, with noise, among outliers and seen from one side: the median radial error against the true surface
as a share of the diagonal, the strips used, and seconds. `--starts`: how many of so many random starts alone, refined without
any search, end at the truth of a clean cloud. `--clouds`: files of points or meshes, and how far their points are from fits of
so many parts at most. `--shapes` without a name leaves the reference shapes out.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table
from scipy.optimize import minimize_scalar

from hqmodel.edit import put
from hqmodel.files import load
from hqmodel.fit import fit, read
from hqmodel.fit.cloud import prepared
from hqmodel.fit.lone import evidence_of
from hqmodel.fit.scene import scene_of
from hqmodel.fit.solve import solved
from hqmodel.fit.starts import held, random_sets
from hqmodel.model import Scene

from .fit_clouds import (
    GOALS,
    KINDS,
    NOISE,
    Array,
    cloud,
    radial_errors,
    random_convex,
    random_superquadric,
    reference_convex,
    true_points,
)

Row = dict[str, Any]
_TOLERANCE = 2e-4


def accuracy(scenes: dict[str, Scene], count: int, console: Console) -> list[Row]:
    """Every kind of cloud of every scene, fitted."""
    table = Table("shape", *KINDS, title=f"median radial error, % of the diagonal; strips; seconds ({count:,} points)")
    rows = []
    for name, scene in scenes.items():
        for kind in KINDS:
            with console.status(f"{name}, {kind}"):
                rows.append({"shape": name, "kind": kind, **_measured(scene, kind, count)})
        table.add_row(name, *[_cell(row) for row in rows[-len(KINDS) :]])
    table.add_section()
    table.add_row("goal", *[f"{GOALS[kind]:.1%}" for kind in KINDS])
    table.add_row("reached", *[_reached([row for row in rows if row["kind"] == kind]) for kind in KINDS])
    console.print(table)
    return rows


def random_starts(scenes: dict[str, Scene], tries: int, console: Console) -> list[Row]:
    """How often a random start alone, of frames of 3, 4 and 6 strips in turn, ends at the truth of a clean cloud."""
    table = Table("shape", "of random starts", title=f"within {GOALS['clean']:.1%} of the diagonal")
    rows = []
    for name, scene in scenes.items():
        rng = np.random.default_rng(1)
        points = prepared(cloud(scene, "clean", 2000, 1), None, rng)
        evidence = evidence_of(points, 1500, rng)
        errors = []
        for directions in random_sets(6, rng, tries):
            found = solved(held(points.points, directions, 3.0), evidence, _TOLERANCE, 40, None, _nothing)
            errors.append(float(np.median(radial_errors(scene_of(found.bodies, points.frame), scene, 400))))
        share = float(np.mean(np.array(errors) < GOALS["clean"]))
        rows.append({"shape": name, "random starts": tries, "share": share})
        table.add_row(name, f"{share:.0%}")
    console.print(table)
    return rows


def thin_plate(plate: Scene, tries: int, count: int, console: Console) -> list[Row]:
    """How near anything can come to a plate thinner than its noise: all is told of it but its thickness.

    The likeliest half-width, a point's height being that of either face and the noise whose deviation is told, too.
    """
    true = plate.shapes[0].strips[2].half_width
    errors = []
    for seed in range(tries):
        height = cloud(plate, "noise", count, seed)[:, 2]
        points = true_points(plate, count, np.random.default_rng(seed))
        sigma = NOISE * float(np.linalg.norm(np.ptp(points, axis=0)))

        def unlikely(half: float, height: Array = height, sigma: float = sigma) -> float:
            faces = (-0.5 * ((height - side * half) / sigma) ** 2 for side in (1, -1))
            return -float(np.sum(np.logaddexp(*faces)))

        half = float(minimize_scalar(unlikely, bounds=(0.2 * true, 3 * true), method="bounded").x)
        found = put(plate, "shapes[0].strips[2].half_width", half)
        errors.append(float(np.median(radial_errors(found, plate, 400))))
    share = float(np.mean(np.array(errors) < GOALS["noise"]))
    table = Table("told all but the thickness", "median", f"clouds within {GOALS['noise']:.1%}", title="thin plate, noise")
    table.add_row(f"{tries} clouds", f"{np.median(errors):.3%}", f"{share:.0%}")
    console.print(table)
    return [{"shape": "thin_plate", "told all but the thickness": tries, "median": float(np.median(errors)), "share": share}]


def parts(files: list[Path], counts: list[int], console: Console) -> list[Row]:
    """Files fitted with several numbers of parts."""
    title = "mean / median / 95 % of the points' distances, % of the diagonal; parts and strips used; seconds"
    table = Table("cloud", *[f"parts: {count}" for count in counts], title=title)
    rows = []
    for path in files:
        cloud = read(path)
        for count in counts:
            with console.status(f"{path.name}, {count} parts"):
                rows.append({"cloud": path.name, "at most": count, **_with_parts(*cloud, count)})
        table.add_row(path.name, *[_parts_cell(row) for row in rows[-len(counts) :]])
    console.print(table)
    return rows


def _with_parts(points: Array, normals: Array | None, count: int) -> Row:
    started = time.perf_counter()
    found = fit(points, normals, parts=count)
    seconds = time.perf_counter() - started
    away = np.abs(found.residuals) / found.report.diagonal
    median, most = np.quantile(away, (0.5, 0.95))
    distances = {"mean": float(np.mean(away)), "median": float(median), "95 %": float(most)}
    return distances | {"parts": found.report.parts, "strips": found.report.strips, "seconds": seconds}


def _parts_cell(row: Row) -> str:
    distances = " / ".join(f"{100 * row[name]:.2f}" for name in ("mean", "median", "95 %"))
    return f"{distances}  {row['parts']}, {row['strips']}  {row['seconds']:.0f}"


def _measured(scene: Scene, kind: str, count: int) -> Row:
    points = cloud(scene, kind, count, 1)
    started = time.perf_counter()
    found = fit(points, tolerance=_TOLERANCE)
    seconds = time.perf_counter() - started
    median, most = np.quantile(radial_errors(found.scene, scene), (0.5, 0.9))
    return {"median": float(median), "most": float(most), "strips": found.report.strips, "seconds": seconds}


def _cell(row: Row) -> str:
    return f"{100 * row['median']:.3f}  {row['strips']}  {row['seconds']:.0f}"


def _reached(rows: list[Row]) -> str:
    return f"{sum(row['median'] < GOALS[row['kind']] for row in rows)} of {len(rows)}"


def _nothing() -> None:
    pass


def main() -> int:
    """The command line above."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fitting", description="How well fits find what is known.")
    parser.add_argument("--shapes", nargs="*", default=None, metavar="NAME")
    parser.add_argument("--random", type=int, default=8, metavar="N")
    parser.add_argument("--superquadrics", type=int, default=4, metavar="N")
    parser.add_argument("--points", type=int, default=4000, metavar="N")
    parser.add_argument("--starts", type=int, default=24, metavar="N")
    parser.add_argument("--clouds", nargs="*", type=Path, default=[], metavar="FILE")
    parser.add_argument("--parts", nargs="+", type=int, default=[1, 4, 8, 16], metavar="N")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    console = Console()
    scenes = reference_convex() if options.shapes is None else {name: load(name) for name in options.shapes}
    scenes |= {f"random {seed}": random_convex(seed) for seed in range(options.random)}
    scenes |= {f"superquadric {seed}": random_superquadric(seed) for seed in range(options.superquadrics)}
    rows = accuracy(scenes, options.points, console) if scenes else []
    if "thin_plate" in scenes:
        rows += thin_plate(scenes["thin_plate"], 50, options.points, console)
    if options.starts and scenes:
        rows += random_starts(scenes, options.starts, console)
    if options.clouds:
        rows += parts(options.clouds, options.parts, console)
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main())
