"""The paper's three ways to solve H = C (section 4), side by side: how far off, how many evaluations, how long.

    python -m benchmarks.solvers [--directions 10000] [--cells 64] [--json FILE]

Each puts points on the surface of star-shaped bodies, and a point's error is its distance from it along the ray from the
centre, as ray casting finds it. Newton's method starts from the approximate solution (33)-(37), and once more from the middle of
its bracket; an evaluation is of the field and its gradient, of the lattice's of the field alone.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

from hqmodel.field import (
    NotStarShaped,
    Region,
    Terms,
    first_hits,
    lattice_search,
    normal_evolution,
    radial_solution,
    region,
    star_centre,
)
from hqmodel.files import load
from hqmodel.model import Scene

from .meshers import machine
from .shapes import shapes

Array = NDArray[np.float64]
# Points (n, 3), how many evaluations each cost, (n,), and the share of points that has arrived.
Solved = tuple[Array, NDArray[Any], float]
Solver = Callable[[Terms, Region, Array, Array], Solved]
_SEED = 34


def _lattice(cells: int, terms: Terms, where: Region, centre: Array, directions: Array) -> Solved:
    found = lattice_search(terms, where, cells)
    points = found.points[found.outermost]
    return points, np.full(len(points), (cells + 1) ** 3 / len(points)), 1.0


def _evolution(terms: Terms, where: Region, centre: Array, directions: Array) -> Solved:
    found = normal_evolution(terms, where, directions)
    return found.points[found.converged], found.iterations, float(found.converged.mean())


def _radial(approximate: bool, terms: Terms, where: Region, centre: Array, directions: Array) -> Solved:
    start = None if approximate else np.full(len(directions), np.nan)
    found = radial_solution(terms, where, centre, directions, start)
    points = centre + found.radius[:, None] * directions
    return points[found.converged], found.iterations, float(found.converged.mean())


def bodies() -> dict[str, tuple[Scene, Array]]:
    """Those of the benchmark's shapes, and of a few presets, that are star-shaped, and their centres."""
    scenes = shapes() | {name: load(name) for name in ("pebble", "fig02-superquadric", "brilliant")}
    found = {}
    for name, scene in scenes.items():
        terms = Terms.of(scene)
        try:
            found[name] = scene, star_centre(terms, region(scene, terms))
        except NotStarShaped:
            print(f"{name} is left out: it is not star-shaped")
    return found


def measured(scene: Scene, centre: Array, solver: Solver, count: int) -> dict[str, Any]:
    """Errors as shares of the longest side, evaluations a point, seconds, and the share of points that arrived."""
    terms = Terms.of(scene)
    where = region(scene, terms)
    directions = np.random.default_rng(_SEED).normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    start = perf_counter()
    points, evaluations, arrived = solver(terms, where, centre, directions)
    seconds = perf_counter() - start
    error = np.abs(_heights(terms, where, centre, points)) / np.max(where.size)
    return {
        "mean_error": float(error.mean()),
        "largest_error": float(error.max()),
        "evaluations": float(evaluations.mean()),
        "most_evaluations": float(evaluations.max()),
        "seconds": seconds,
        "points": len(points),
        "arrived": arrived,
    }


def _heights(terms: Terms, where: Region, centre: Array, points: Array) -> Array:
    """How far the points (n, 3) lie above the surface along their rays from the centre, (n,)."""
    radius = np.linalg.norm(points - centre, axis=1)
    outwards = (points - centre) / radius[:, None]
    far = 2 * float(np.linalg.norm(where.size))
    return np.asarray(radius - (far - first_hits(terms, where, centre + far * outwards, -outwards)))


def _cell(run: dict[str, Any]) -> str:
    arrived = "" if run["arrived"] == 1 else f", {1 - run['arrived']:.0%} lost"
    evaluations = f"{run['evaluations']:.1f} ({run['most_evaluations']:.0f})"
    return f"{run['mean_error']:.0e}, {evaluations}, {run['seconds'] * 1e6 / max(run['points'], 1):.1f}{arrived}"


def main() -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--directions", type=int, default=10_000)
    parser.add_argument("--cells", type=int, default=64, help="the lattice's, along each side")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    console = Console(width=None if sys.stdout.isatty() else 150)
    console.print(machine())
    found = bodies()
    solvers: dict[str, Solver] = {
        f"lattice of {options.cells}": partial(_lattice, options.cells),
        "normal evolution": _evolution,
        "radial Newton": partial(_radial, True),
        "radial, from the middle": partial(_radial, False),
    }
    title = f"{options.directions} directions: mean error, evaluations a point (most), microseconds a point"
    table = Table("", *solvers, title=title)
    rows = []
    for body, (scene, centre) in found.items():
        runs = {name: measured(scene, centre, solver, options.directions) for name, solver in solvers.items()}
        table.add_row(body, *map(_cell, runs.values()))
        rows += [{"solver": name, "body": body, **run} for name, run in runs.items()]
    console.print(table)
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
