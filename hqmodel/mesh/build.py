"""From a scene to a watertight mesh: tiles culled by exact bounds, marched, welded by edge, vertices on the surface."""

from __future__ import annotations

import os
import threading
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor, wait
from dataclasses import replace
from functools import partial
from math import ceil, inf
from typing import TypeVar

import numpy as np

from hqmodel.field import (
    Region,
    Terms,
    mirror_axes,
    region,
)
from hqmodel.model import Scene

from .balance import Balance
from .creases import sharp_vertices
from .cull import Blocks, blocks_of, relevant, tiles
from .extract import AT_NODE, extract
from .finish import finished
from .grid import BLOCK, make_grid
from .measure import furthest
from .mesh import Mesh, MeshError, rows
from .refine import place_vertices
from .sampling import Sampling, by_cube
from .shade import clothed
from .tolerance import COARSE, MOST, fineness, finer
from .weld import Piece, Weld

Result = TypeVar("Result")
Progress = Callable[[float, str], None]
USUAL_RESOLUTION, MAX_RESOLUTION = 256, 2048
FEWEST_FACES = 4
# The share of the work that is done when all is meshed, where faces are to be reduced, and when only the report is left.
_FIRST, _LAST = 0.15, 0.95
# A body so many times smaller than its region is meshed again, with cells that are its own longest side's, but at most so many
# times smaller.
_LOOSE, _FINER = 1.2, 4.0
# Neighbouring blocks that make one job: no more, so that it stays small in memory, and where there are several jobs no fewer, so
# that NumPy's calls are worth it. Where there are enough blocks jobs come in so many, even ones.
RUN, LEAST, _EVEN = 6400, 1500, 4
# Seconds between two looks at whether a piece is done, or no longer wanted.
_LOOK = 0.1
# The coarsest step between numbers, as a share of the longest side.
_COARSEST = 1e-7


def polygonize(
    scene: Scene,
    resolution: int | None = None,
    progress: Progress | None = None,
    *,
    shading: bool = True,
    target_faces: int | None = None,
    tolerance: float | None = None,
) -> Mesh:
    """The scene's body as a closed triangle mesh in world units, outward normals and sRGB colours included if `shading`.

    `resolution` is the number of cells along the body's longest side: 256, or what the tolerance asks for. `progress` is told the
    share done (0..1) and what is being done; whatever it raises ends the work. A scene that is its own mirror image gives a mesh
    that is, to the last bit.
    `target_faces`: the mesh is reduced to at most so many triangles, where they are missed least, as far as it stays sound.
    `tolerance`: no point of the mesh is to be further from the true surface, in world units; there are as few triangles as that
    takes. Where it can't be met the mesh's `surface_error` says how far it is off.

    Raises MeshError when there is no surface, when the body has no end, or when a number is out of range.
    """
    if resolution is not None and not 4 <= resolution <= MAX_RESOLUTION:
        raise MeshError(f"resolution: expected a whole number from 4 to {MAX_RESOLUTION}, got {resolution}")
    if target_faces is not None and target_faces < FEWEST_FACES:
        raise MeshError(f"target faces: expected a whole number of at least {FEWEST_FACES}, got {target_faces}")
    if tolerance is not None and not 0 < tolerance < inf:
        raise MeshError(f"tolerance: expected a number above 0, got {tolerance:g}")
    tell = progress or _silent
    tell(0.0, "Finding the body")
    if tolerance is None or resolution is not None:
        mesh = _mesh(scene, resolution or USUAL_RESOLUTION, tell, target_faces, tolerance)
    else:
        cells = fineness(Terms.of(scene), _mesh(scene, COARSE, _silent), tolerance)
        mesh = _mesh(scene, cells, tell, target_faces, tolerance)
        while (mesh.surface_error or 0.0) > tolerance and cells < MOST:
            cells = min(MOST, finer(cells, mesh.surface_error or 0.0, tolerance))
            mesh = _mesh(scene, cells, tell, target_faces, tolerance)
    tell(1.0, "Done")
    return mesh if shading else replace(mesh, normals=None, colors=None)


def _mesh(scene: Scene, resolution: int, tell: Progress, target_faces: int | None = None, tolerance: float | None = None) -> Mesh:
    terms = Terms.of(scene)
    where = region(scene, terms)
    _must_exist(scene, where)
    _must_be_near(where)
    mirrored = mirror_axes(terms, where)
    reducing = target_faces is not None or tolerance is not None
    meshed = _FIRST if reducing else _LAST
    balance = Balance.of(make_grid(where, resolution, mirrored), mirrored, float(np.max(where.size)))
    weld = _welded(scene, terms, balance, meshed, tell)
    longest = weld.longest(mirrored)
    wider = float(np.max(where.size)) / longest
    if wider > _LOOSE:
        del weld  # makes room for the next
        balance = Balance.of(make_grid(where, ceil(resolution * min(wider, _FINER)), mirrored), mirrored, longest)
        weld = _welded(scene, terms, balance, meshed, tell)

    def finishing(done: float) -> None:
        tell(meshed + done * (_LAST - meshed), "Reducing" if reducing else "Joining")

    mesh = finished(scene, terms, balance, weld, target_faces, tolerance, finishing)
    return replace(mesh, resolution=resolution)


def _welded(scene: Scene, terms: Terms, balance: Balance, meshed: float, tell: Progress) -> Weld:
    """All pieces; `tell` is told the share done, which is `meshed` at the end."""
    weld = Weld()
    for piece, share in _pieces(scene, terms, balance, lambda share: tell(meshed * share, "Meshing")):
        weld.add(piece, share)
    if not weld:
        raise MeshError("no surface: the field does not reach its level anywhere at this resolution")
    return weld


def _silent(share: float, doing: str) -> None:
    pass


def _must_exist(scene: Scene, where: Region) -> None:
    if where.empty:
        seen = any(shape.visible for shape in scene.shapes)
        reason = "the field is below its level everywhere" if seen else "there is no visible shape"
        raise MeshError(f"no surface: {reason}")
    if not where.bounded:
        raise MeshError("bounds: expected a box to cut the body by, as it runs on without end, got none")


def _must_be_near(where: Region) -> None:
    """Raise MeshError where float64 itself is too coarse for the body's size."""
    away, side = float(np.max(np.abs([where.low, where.high]))), float(np.max(where.size))
    if not np.spacing(away) < _COARSEST * side:
        raise MeshError(f"expected a body nearer to the origin, got one {side:.3g} long at a distance of {away:.3g}")


def _pieces(scene: Scene, terms: Terms, balance: Balance, tell: Callable[[float], None]) -> Iterator[tuple[Piece, float]]:
    """The mesh in pieces, each with the share of the blocks that are done with it, which `tell` is told again and again."""
    share, stopped = 0.0, threading.Event()

    def waiting() -> None:
        tell(share)

    every, size = tiles(terms, balance.grid)
    found = _in_order(partial(blocks_of, terms, balance.grid, size), list(every), waiting, threading.Event())
    blocks = np.concatenate([np.empty((0, 3), dtype=np.int32), *found], dtype=np.int32, casting="same_kind")
    run = ceil(len(blocks) / _runs(len(blocks)))
    ends = range(run, len(blocks) + run, run)
    runs: list[Blocks] = [blocks[end - run : end] for end in ends]
    work = partial(_piece, scene, terms, by_cube(terms, balance.grid), balance, stopped)
    pieces = _in_order(work, runs, waiting, stopped)
    for piece, end in zip(pieces, ends, strict=True):
        share = min(end / len(blocks), 1.0)
        if piece is not None:
            yield piece, share
        waiting()


def _runs(blocks: int) -> int:
    """How many jobs so many blocks make: the same on every machine, as the order of vertices follows from it."""
    count = _EVEN * ceil(blocks / (_EVEN * RUN))
    while count > 1 and blocks < LEAST * count:
        count //= 2
    return count


def _in_order(
    work: Callable[[Blocks], Result], jobs: list[Blocks], waiting: Callable[[], None], stopped: threading.Event
) -> Iterator[Result]:
    """What `work` makes of the jobs, in their order, on all cores.

    `waiting` is called meanwhile; when it raises, or nobody wants more, `stopped` is set.
    """
    ahead = os.cpu_count() or 1
    with ThreadPoolExecutor(ahead) as pool:
        under_way = deque[Future[Result]]()
        try:
            for number in range(len(jobs) + ahead):
                if number < len(jobs):
                    under_way.append(pool.submit(work, jobs[number]))
                if number >= ahead and under_way:  # no further ahead, so that results don't pile up
                    first = under_way.popleft()
                    while not wait([first], _LOOK).done:
                        waiting()
                    yield first.result()
        finally:
            stopped.set()
            pool.shutdown(wait=True, cancel_futures=True)


def _piece(
    scene: Scene, terms: Terms, within: Callable[[int], Terms], balance: Balance, stopped: threading.Event, blocks: Blocks
) -> Piece | None:
    def still() -> None:
        if stopped.is_set():
            raise CancelledError  # nobody looks at the result any more

    grid, local = balance.grid, relevant(terms, balance.grid, blocks, BLOCK)
    patch = extract(blocks, Sampling(terms, within, local, grid, still))
    still()
    if patch is None or not len(patch.faces):
        return None
    node, axis = patch.node, patch.axis
    faces = np.asfortranarray(patch.faces, dtype=np.intp)  # corner by corner, in numbers that needn't be converted
    vertices, slopes = place_vertices(local, grid, node, axis, patch.ends, patch.aside, still)
    still()
    normals, colors, off = clothed(scene, local, grid, vertices, slopes, faces, within=axis == AT_NODE)
    pulls = balance.pulls(faces, off, normals)
    step = np.where(patch.shared, np.float32(0), balance.steps(pulls))
    balance.move(vertices, normals, step)
    shared = np.flatnonzero(patch.shared)
    return Piece(
        keys=patch.keys(grid)[shared],
        shared=shared,
        vertices=vertices,
        normals=normals,
        colors=colors,
        pulls=rows(pulls, shared),
        pinched=patch.pinched,
        sharp=sharp_vertices(faces, off, normals),
        faces=patch.faces,
        worst=furthest(balance.sunk(off, faces, step)),
    )
