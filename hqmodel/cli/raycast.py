"""hqmodel raycast: where given rays first enter the body."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from time import perf_counter
from typing import Annotated, TypeVar

import numpy as np
import typer

from hqmodel.model import Scene

from .faults import MACHINE, Fault
from .options import Json, Preset, Quiet, Set, Slice, scene_of
from .outputs import checked, tell, writing
from .progress import progress
from .table import Array, Rows, header_of, rows, text_of

T = TypeVar("T")

COLUMNS = ("ox", "oy", "oz", "dx", "dy", "dz")

Rays = Annotated[Path, typer.Argument(metavar="RAYS.csv", help="A table with the columns ox,oy,oz,dx,dy,dz.")]
Output = Annotated[Path, typer.Option("-o", "--output", metavar="OUT.csv", help="The table to write.")]
Cpu = Annotated[bool, typer.Option("--cpu", help="By the reference in NumPy instead of the preview's own intersection.")]


def raycast(
    preset: Preset,
    rays: Rays,
    output: Output,
    cpu: Cpu = False,
    slice_t: Slice = None,
    settings: Set = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Find where rays first enter the body.

    The column distance is in world units, whatever the length of the directions; empty where a ray misses.
    """
    started = perf_counter()
    scene = scene_of(preset, slice_t, settings)
    checked([output], (), [preset])
    cast = _on_cpu(scene) if cpu else _on_gpu(scene)
    count = hits = 0
    with progress(quiet) as report, writing([output]) as (stream,):
        stream.write(header_of((*COLUMNS, "distance")))
        for block in rows(rays, COLUMNS):
            distance = cast(block.values[:, :3], _directions(rays, block))
            stream.write(text_of(np.column_stack([block.values, distance])))
            count += len(distance)
            hits += int(np.count_nonzero(~np.isnan(distance)))
            report(block.share, "Casting")
    seconds = perf_counter() - started
    device = "cpu" if cpu else "gpu"
    result = {"rays": count, "hits": hits, "misses": count - hits, "device": device, "seconds": seconds, "files": [str(output)]}
    tell(result, f"{output}: {count:,} rays, {hits:,} hits, {seconds:.1f} s", as_json, quiet)


def _directions(path: Path, block: Rows) -> Array:
    """Unit vectors; scaled by the largest component first, so that no length is too long or too short."""
    directions = block.values[:, 3:]
    largest = np.max(np.abs(directions), axis=1, keepdims=True)
    if not largest.all():
        line = block.lines[int(np.argmin(largest))]
        raise Fault(f"{path}: line {line}: expected a direction that is not zero, got 0,0,0")
    scaled = directions / largest
    return np.asarray(scaled / np.linalg.norm(scaled, axis=1, keepdims=True))


def _on_cpu(scene: Scene) -> Callable[[Array, Array], Array]:
    from hqmodel.field import Terms, first_hits, region

    terms = Terms.of(scene)
    where = region(scene, terms)
    return lambda origins, directions: first_hits(terms, where, origins, directions)


def _on_gpu(scene: Scene) -> Callable[[Array, Array], Array]:
    from hqmodel import gpu

    context = _through_opengl(gpu.offscreen)
    return lambda origins, directions: _through_opengl(lambda: gpu.raycast(scene, origins, directions, context))


def _through_opengl(work: Callable[[], T]) -> T:
    """What the work gives; Fault where there is no OpenGL, or it fails."""
    from hqmodel.gpu import GpuError

    try:
        return work()
    except GpuError as error:
        raise Fault(f"{error}; --cpu needs none", MACHINE) from None
