"""How near the meshes come to the true surface: 20,000 of its points, each one's distance from the mesh.

    python -m benchmarks.accuracy [--cells 256] [--gamma 400] [--json FILE]

The points are where random lines, cast from outside, first meet the body; distances are to the nearest point of any triangle,
by VTK. With `--gamma`, a dodecahedron and a box with that exponent instead, against plain marching cubes of as many triangles.
`pip install -e ".[bench]"` brings the other programs.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

from hqmodel.field import Terms, first_hits, region
from hqmodel.model import Scene, Shape, Strip

from .rivals import ABSENT, MESHERS, Mesher, Surface, hqmodel, scikit_image
from .sampling import HIGH, LOW
from .shapes import shapes

Array = NDArray[np.float64]
COUNT = 20_000
_SEED = 20_000
# The sparse batches' triangles are the dense grid's.
METHODS = [name for name in MESHERS if not name.startswith("sparse")]


def true_points(scene: Scene, count: int = COUNT) -> Array:
    """Points (count, 3) of the scene's surface.

    The lines are uniform in space, so that on a convex body the points are uniform by area (Cauchy and Crofton). Hollows get
    the fewer the less of them is seen from outside.
    """
    terms = Terms.of(scene)
    where = region(scene, terms)
    centre, radius = (where.low + where.high) / 2, float(np.linalg.norm(where.size)) / 2
    rng = np.random.default_rng(_SEED)
    found = np.empty((0, 3))
    while len(found) < count:
        along = _unit(rng.normal(size=(count, 3)))
        across = _unit(np.cross(along, rng.normal(size=(count, 3))))
        origins = centre - 2 * radius * along + radius * np.sqrt(rng.uniform(size=(count, 1))) * across
        distance = first_hits(terms, where, origins, along)
        found = np.concatenate([found, (origins + distance[:, None] * along)[np.isfinite(distance)]])
    return found[:count]


def _unit(vectors: Array) -> Array:
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def distances(points: Array, surface: Surface) -> Array:
    """Distance (n,) from each point (n, 3) to the nearest triangle."""
    vertices, faces = surface
    places, cells = vtkPoints(), vtkCellArray()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(vertices, dtype=float)))
    corners = np.ascontiguousarray(faces, dtype=np.int64).reshape(-1)
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, len(corners) + 1, 3)), numpy_to_vtkIdTypeArray(corners))
    mesh = vtkPolyData()
    mesh.SetPoints(places)
    mesh.SetPolys(cells)
    surroundings, signed = vtkImplicitPolyDataDistance(), vtkDoubleArray()
    surroundings.SetInput(mesh)
    surroundings.EvaluateFunction(numpy_to_vtk(points), signed)
    return np.abs(vtk_to_numpy(signed))


def error(scene: Scene, points: Array, mesher: Mesher, cells: int) -> dict[str, Any]:
    """Mean and largest distance of the points from a mesh, and its triangles; or only why there is none."""
    try:
        surface = mesher(scene, cells)
    except ModuleNotFoundError as fault:
        return {"none": str(fault)}
    away = distances(points, surface)
    return {"mean": float(away.mean()), "largest": float(away.max()), "faces": len(surface[1]), "cells": cells}


def compare(console: Console, cells: int) -> list[dict[str, Any]]:
    """Every mesher on every shape with cells of the same size."""
    table = Table("mean / largest distance, triangles", *shapes(), title=f"{cells} cells over a box of side {HIGH - LOW:g}")
    points = {shape: true_points(scene) for shape, scene in shapes().items()}
    rows = []
    for method in METHODS:
        runs = [error(scene, points[shape], MESHERS[method], cells) for shape, scene in shapes().items()]
        table.add_row(method, *map(_cell, runs))
        rows += [{"method": method, "shape": shape, **run} for shape, run in zip(shapes(), runs, strict=True)]
    console.print(table)
    return rows


def sharp(console: Console, cells: int, gamma: float) -> list[dict[str, Any]]:
    """Bodies with edges, against plain marching cubes of about as many triangles."""
    table = Table("mean / largest distance, triangles", "hqmodel", "dense, scikit-image", "nearer", title=f"gamma {gamma:g}")
    rows = []
    for shape, scene in _edged(gamma).items():
        points = true_points(scene)
        ours = error(scene, points, hqmodel, cells)
        same = len(scikit_image(scene, cells)[1])
        plain = error(scene, points, scikit_image, round(cells * (ours["faces"] / same) ** 0.5))
        nearer = [plain[what] / ours[what] for what in ("mean", "largest")]
        table.add_row(shape, _cell(ours), _cell(plain), "{:.1f}x / {:.1f}x".format(*nearer))
        rows += [{"method": name, "shape": shape, **run} for name, run in (("hqmodel", ours), ("dense, scikit-image", plain))]
    console.print(table)
    return rows


def _edged(gamma: float) -> dict[str, Scene]:
    (solid,) = shapes()["dodecahedral, gamma 40"].shapes
    sides = [((1, 0, 0), 1.0), ((0, 1, 0), 0.8), ((0, 0, 1), 0.6)]
    box = tuple(Strip(normal=normal, half_width=half) for normal, half in sides)
    return {
        name: Scene(shapes=(Shape(strips=tuple(strip.changed(gamma=gamma) for strip in strips)),))
        for name, strips in (("dodecahedron", solid.strips), ("box", box))
    }


def _cell(run: dict[str, Any]) -> str:
    return f"{run['mean']:.1e} / {run['largest']:.1e}, {run['faces']}" if "mean" in run else str(run["none"])


def main() -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cells", type=int, help="256, or 128 with --gamma")
    parser.add_argument("--gamma", type=float)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    console = Console(width=None if sys.stdout.isatty() else 190)
    console.print(ABSENT)
    rows = sharp(console, options.cells or 128, options.gamma) if options.gamma else compare(console, options.cells or 256)
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
