"""From a scene to a watertight mesh: tiles culled by exact bounds, marched, welded by edge, vertices on the surface."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import (
    Region,
    Terms,
    log_ratio,
    mirror_axes,
    mixed_colors,
    near_linear,
    near_linear_gradient,
    region,
    relevant_terms,
)
from hqmodel.model import Scene

from .cull import TILE, Blocks, blocks_of, tiles
from .extract import AT_NODE, NODES, Patch, extract
from .grid import Grid, make_grid
from .manifold import parted
from .measure import largest_distance
from .mesh import Array, Mesh, MeshError, Triangles, reflected
from .refine import place_vertices
from .weld import Piece, Weld

Progress = Callable[[float, str], None]
MAX_RESOLUTION = 2048
# Samples this near to the level are rounding: fields that stay at their level throughout (an octahedron's slices) have no body.
_ROUNDING = 1e-13
# The coarsest step between numbers, as a share of the longest side.
_COARSEST = 1e-7


def polygonize(scene: Scene, resolution: int = 256, progress: Progress | None = None, *, shading: bool = True) -> Mesh:
    """The scene's body as a closed triangle mesh in world units, outward normals and sRGB colours included if `shading`.

    `resolution` is the number of cells along the body's longest side. `progress` is told the share done (0..1) and what is
    being done; whatever it raises ends the work. A scene that is its own mirror image gives a mesh that is, to the last bit.

    Raises MeshError when there is no surface, when the body has no end, or when the resolution is out of range.
    """
    if not 4 <= resolution <= MAX_RESOLUTION:
        raise MeshError(f"resolution: expected a whole number from 4 to {MAX_RESOLUTION}, got {resolution}")
    tell = progress or _silent
    tell(0.0, "Finding the body")
    terms = Terms.of(scene)
    where = region(scene, terms)
    _must_exist(scene, where)
    _must_be_near(where)
    mirrored = mirror_axes(terms, where)
    grid = make_grid(where, resolution, mirrored)
    weld = Weld()
    for piece in _pieces(scene, terms, grid, shading, tell):
        if piece is not None:
            weld.add(piece)
    if not weld:
        raise MeshError("no surface: the field does not reach its level anywhere at this resolution")
    tell(0.95, "Joining")
    mesh = weld.mesh()
    for axis in mirrored:
        mesh = reflected(mesh, axis)
    mesh = parted(mesh)
    tell(1.0, "Done")
    return mesh


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


def _pieces(scene: Scene, terms: Terms, grid: Grid, shading: bool, tell: Progress) -> Iterator[Piece | None]:
    """The tiles' pieces in order, worked out on all cores."""
    jobs = tiles(terms, grid)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        try:
            for number, piece in enumerate(pool.map(lambda tile: _piece(scene, terms, grid, tile, shading), jobs)):
                tell(0.95 * (number + 1) / len(jobs), "Meshing")
                yield piece
        finally:
            pool.shutdown(wait=True, cancel_futures=True)


def _piece(scene: Scene, terms: Terms, grid: Grid, tile: Blocks, shading: bool) -> Piece | None:
    low, high = grid.corners(tile.reshape(1, 3), TILE)
    local = relevant_terms(terms, low[0], high[0])
    blocks = blocks_of(local, grid, tile)
    if not len(blocks):
        return None
    patch = extract(blocks, lambda some: _samples(local, grid, some), 1.0 / _step(local, grid))
    keys, first, inverse = np.unique(_keys(patch.edge, grid), return_index=True, return_inverse=True)
    faces = inverse.reshape(-1).astype(np.int32)[patch.faces]
    faces = faces[np.all(faces != np.roll(faces, 1, axis=1), axis=1)]  # edges without length close up at the ends of cuts
    if not len(faces):
        return None
    patch = Patch(patch.edge[first], patch.place[first], patch.ends[first], faces)
    vertices = place_vertices(local, grid, patch)
    slope = near_linear_gradient(local, vertices)[1]
    size = np.linalg.norm(slope, axis=1)
    error = largest_distance(local, vertices, _off_cuts(faces, vertices, grid), size, grid.cell)
    shared = np.any((patch.edge[:, :3] % TILE == 0) & (patch.edge[:, 3:] != np.arange(3)), axis=1)
    if not shading:
        return Piece(keys, shared, vertices, faces, None, None, error)
    normals = _with_caps(slope / -np.maximum(size, 1e-200)[:, None], vertices, patch.edge[:, 3] == AT_NODE, grid)
    colors = np.rint(mixed_colors(scene, local, vertices) * 255).astype(np.uint8)
    return Piece(keys, shared, vertices, faces, normals, colors, error)


def _off_cuts(faces: Triangles, vertices: Array, grid: Grid) -> Triangles:
    """The faces that are no part of a cap."""
    for axis, plane, _ in grid.cuts:
        faces = faces[~np.all(vertices[:, axis][faces] == plane, axis=1)]
    return faces


def _with_caps(normals: Array, vertices: Array, within: NDArray[np.bool_], grid: Grid) -> NDArray[np.float32]:
    """Normals (V, 3) with those of the caps: alone `within` a cap, halfway between the two on its rim."""
    normals = np.where(within[:, None], 0.0, normals)
    for axis, plane, side in grid.cuts:
        normals[:, axis] += np.where(vertices[:, axis] == plane, side, 0.0)
    return (normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-200)).astype(np.float32)


def _step(terms: Terms, grid: Grid) -> float:
    """About how much the near-linear field changes across a cell."""
    return grid.cell * float(np.median(np.linalg.norm(terms.normal, axis=1))) if len(terms) else 1.0


def _samples(terms: Terms, grid: Grid, blocks: Blocks) -> Array:
    """The near-linear field at the nodes of blocks, (n, 5, 5, 5); -inf beyond a cut."""
    steps = np.arange(NODES)
    index = [blocks[:, i, None] + steps for i in range(3)]
    x, y, z = (nodes[i] for nodes, i in zip(grid.nodes, index, strict=True))
    points = np.empty((len(blocks), NODES, NODES, NODES, 3))
    points[..., 0], points[..., 1], points[..., 2] = x[:, :, None, None], y[:, None, :, None], z[:, None, None, :]
    values = near_linear(terms, log_ratio(terms, points))
    values[np.abs(values) < _ROUNDING] = -_ROUNDING
    beyond = [outside[i] for outside, i in zip(grid.outside, index, strict=True)]
    if any(part.any() for part in beyond):
        bx, by, bz = beyond
        values[bx[:, :, None, None] | by[:, None, :, None] | bz[:, None, None, :]] = -np.inf
    return values


def _keys(edge: NDArray[np.int64], grid: Grid) -> NDArray[np.int64]:
    """One number for each grid edge."""
    _, ny, nz = (len(nodes) for nodes in grid.nodes)
    return ((edge[:, 0] * ny + edge[:, 1]) * nz + edge[:, 2]) * (AT_NODE + 1) + edge[:, 3]
