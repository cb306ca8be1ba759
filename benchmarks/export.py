"""Export against a dense grid: time and peak memory of both, on the same shapes, side by side in one run.

    python -m benchmarks.export [--cells 256 384 512] [--json FILE]

The dense grid is written as well as that way allows: float32, evaluated in slabs that fit the cache, a field made near-linear,
scikit-image's marching cubes over the whole volume. It welds nothing (one volume has no seams), moves no vertex and gives no
normals; hqmodel's time is of its whole export: welded, every vertex on the surface, normals, colours and the error measured.
Each measurement is a process of its own; peak memory is the process's, less what it holds after its imports.
"""

from __future__ import annotations

import argparse
import json
import platform
import resource
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, region
from hqmodel.mesh import polygonize
from hqmodel.model import Scene

from .shapes import shapes

Floats = NDArray[np.float32]
_SLAB = 1 << 18


def dense(scene: Scene, cells: int) -> int:
    """Faces of a dense float32 grid's marching cubes."""
    from skimage.measure import marching_cubes

    terms = Terms.of(scene)
    where = region(scene, terms)
    step = np.float32(np.max(where.size) / cells)
    axes = [
        np.arange(low - step / 2, high + step, step, dtype=np.float32) for low, high in zip(where.low, where.high, strict=True)
    ]
    volume = np.empty([len(axis) for axis in axes], dtype=np.float32)
    rows = max(1, _SLAB // (len(axes[1]) * len(axes[2])))
    for start in range(0, len(axes[0]), rows):
        volume[start : start + rows] = _slab(terms, axes[0][start : start + rows], axes[1], axes[2])
    return len(marching_cubes(volume, 0.0)[1])


def _slab(terms: Terms, x: Floats, y: Floats, z: Floats) -> Floats:
    """The near-linear field on a slab, in float32, term by term."""
    one = np.float32(1.0)
    total: Floats | None = None
    for k in range(len(terms)):
        h_sum = np.zeros((len(x), len(y), len(z)), dtype=np.float32)
        for a in np.flatnonzero(terms.term_of_strip == k):
            nx, ny, nz = terms.normal[a].astype(np.float32)
            h = np.abs((nx * x)[:, None, None] + (ny * y)[:, None] + (nz * z + np.float32(terms.offset[a])))
            h_sum += h ** np.float32(terms.inner[a])
        if len(terms) == 1:
            return one - h_sum ** np.float32(1 / terms.outer.max())
        part = np.float32(terms.hardness[k]) * (np.float32(terms.constant[k]) - h_sum)
        total = part if total is None else np.logaddexp(total, part)
    assert total is not None
    r = np.maximum(one - total / np.float32(terms.hardness.max()), np.float32(1e-30))
    return one - r ** np.float32(1 / terms.outer.max())


def _measure(method: str, name: str, cells: int) -> None:
    """In a process of its own: one measurement, printed as JSON."""
    scene = shapes()[name]

    def work(n: int) -> int:
        return dense(scene, n) if method == "dense" else len(polygonize(scene, n).faces)

    work(32)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.perf_counter()
    faces = work(cells)
    seconds = time.perf_counter() - start
    peak = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
    print(json.dumps({"seconds": seconds, "mebibytes": peak, "faces": faces}))


def _run(method: str, name: str, cells: int) -> dict[str, Any]:
    command = [sys.executable, "-m", "benchmarks.export", "--one", method, name, str(cells)]
    return dict(json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout))


def _columns(measured: dict[str, Any]) -> str:
    return f"{measured['seconds']:8.2f} {measured['mebibytes']:6.0f}"


def main() -> None:
    """Run and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cells", type=int, nargs="+", default=[256, 384, 512])
    parser.add_argument("--json", type=Path)
    parser.add_argument("--one", nargs=3, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.one:
        _measure(options.one[0], options.one[1], int(options.one[2]))
        return
    rows = []
    print(f"{platform.processor() or platform.machine()}, NumPy {np.__version__}, Python {platform.python_version()}")
    print("shape                    cells |  dense s    MiB |  hqmodel s    MiB     faces | faster memory")
    for name in shapes():
        for cells in options.cells:
            peer, ours = _run("dense", name, cells), _run("hqmodel", name, cells)
            rows.append({"shape": name, "cells": cells, "dense": peer, "hqmodel": ours})
            faster, memory = peer["seconds"] / ours["seconds"], ours["mebibytes"] / peer["mebibytes"]
            print(f"{name:24} {cells:5} | {_columns(peer)} |  {_columns(ours)} {ours['faces']:9} |", end=" ")
            print(f"{faster:5.1f}x {memory:5.2f}x", flush=True)
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
