"""hqmodel and the other meshers, each a function of a scene and the number of cells across the box [-1.5, 1.5]^3.

All are handed the same field, as well as each can take it. What isn't installed raises ModuleNotFoundError.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from itertools import product
from math import log2

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, box_bounds, near_linear_gradient, region
from hqmodel.mesh import polygonize
from hqmodel.model import Scene

from .sampling import HIGH, LOW, Floats, axis, near_linear, volume

Surface = tuple[NDArray[np.floating], NDArray[np.integer]]
Mesher = Callable[[Scene, int], Surface]

BATCH = 32
# Rounded coordinates of 21 bits each make one number of 63.
_BITS = 21


def hqmodel(scene: Scene, cells: int) -> Surface:
    """Our whole export, with cells of the same size: welded, every vertex on the surface, normals, colours, error measured."""
    longest = float(np.max(region(scene, Terms.of(scene)).size))
    mesh = polygonize(scene, round(longest / ((HIGH - LOW) / cells)))
    return mesh.vertices, mesh.faces


def scikit_image(scene: Scene, cells: int) -> Surface:
    """scikit-image's marching cubes (Lewiner et al. 2003) of the dense grid."""
    from skimage.measure import marching_cubes

    vertices, faces, _, _ = marching_cubes(volume(Terms.of(scene), cells), 0.0)
    return _placed(vertices, cells), faces


def flying_edges(scene: Scene, cells: int) -> Surface:
    """VTK's flying edges (Schroeder et al. 2015) of the dense grid, on all cores: bare triangles."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkSMPTools
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D

    vtkSMPTools.SetBackend("STDThread")
    values = volume(Terms.of(scene), cells)
    image = vtkImageData()
    image.SetDimensions(values.shape)  # VTK's first axis runs quickest, NumPy's last: turned back below
    image.GetPointData().SetScalars(numpy_to_vtk(values.reshape(-1)))
    edges = vtkFlyingEdges3D()
    edges.SetInputData(image)
    edges.SetValue(0, 0.0)
    edges.ComputeNormalsOff()
    edges.ComputeGradientsOff()
    edges.ComputeScalarsOff()
    edges.Update()
    surface = edges.GetOutput()
    vertices = vtk_to_numpy(surface.GetPoints().GetData())[:, ::-1]
    faces = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return _placed(vertices, cells), faces


def pymcubes(scene: Scene, cells: int) -> Surface:
    """PyMCubes' marching cubes of the dense grid."""
    from mcubes import marching_cubes

    vertices, faces = marching_cubes(volume(Terms.of(scene), cells), 0.0)
    return _placed(vertices, cells), faces


def sparse_batches(scene: Scene, cells: int, exact: bool, merged: bool) -> Surface:
    """Batches of 32^3 cells as fogleman/sdf has them, in a pool of threads, those without surface passed by.

    That program passes by what the distance at a batch's centre rules out, where its corners are on one side. `exact`: by our
    exact bounds instead, which rule out more, and never too much. `merged` joins vertices at the seams whose rounded coordinates
    agree, else they are left double.
    """
    terms, nodes = Terms.of(scene), axis(cells)
    starts = np.arange(0, cells, BATCH)
    first = np.stack(np.meshgrid(starts, starts, starts, indexing="ij"), axis=-1).reshape(-1, 3)
    low, high = nodes[first], nodes[np.minimum(first + BATCH, cells)]
    chosen = _by_bounds(terms, low, high) if exact else _by_distance(terms, low, high)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(partial(_batch, terms, nodes), first[chosen]))
    shift = np.cumsum([0] + [len(vertices) for vertices, _ in found])
    vertices = _placed(np.concatenate([vertices for vertices, _ in found]), cells)
    faces = np.concatenate([faces + start for (_, faces), start in zip(found, shift[:-1], strict=True)])
    return _merged(vertices, faces) if merged else (vertices, faces)


def _by_bounds(terms: Terms, low: Floats, high: Floats) -> NDArray[np.bool_]:
    lower, upper = box_bounds(terms, low, high)
    return (lower <= 0) & (upper > 0)


def _by_distance(terms: Terms, low: Floats, high: Floats) -> NDArray[np.bool_]:
    """Whether the centre is no further than the corners, judged by the steepest slope at any, or these are on two sides."""
    corners = np.where(np.array(list(product([False, True], repeat=3)))[:, None], high, low)
    values, slopes = near_linear_gradient(terms, np.concatenate([corners, (low + high)[None] / 2]))
    distance = np.abs(values[-1]) / np.max(np.linalg.norm(slopes, axis=-1))
    inside = values[:-1] > 0
    return (distance <= np.linalg.norm(high - low, axis=1) / 2) | (inside.any(axis=0) != inside.all(axis=0))


def isomesh(scene: Scene, cells: int) -> Surface:
    """isomesh's dual contouring on an octree, with exact gradients, evaluated on all cores; of several bodies it keeps one."""
    from isomesh import extract

    terms, cores = Terms.of(scene), os.cpu_count() or 1
    with ThreadPoolExecutor(cores) as pool:

        def field(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
            parts = pool.map(partial(near_linear_gradient, terms), np.array_split(points, cores))
            values, slopes = zip(*parts, strict=True)
            return -np.concatenate(values), -np.concatenate(slopes)

        return extract(field, bbox_min=(LOW,) * 3, bbox_max=(HIGH,) * 3, max_depth=round(log2(cells)))


MESHERS: dict[str, Mesher] = {
    "hqmodel": hqmodel,
    "dense, scikit-image": scikit_image,
    "dense, VTK flying edges": flying_edges,
    "dense, PyMCubes": pymcubes,
    "sparse batches": partial(sparse_batches, exact=False, merged=False),
    "sparse batches, merged": partial(sparse_batches, exact=False, merged=True),
    "sparse batches by our bounds": partial(sparse_batches, exact=True, merged=False),
    "sparse batches by our bounds, merged": partial(sparse_batches, exact=True, merged=True),
    "isomesh": isomesh,
}
ABSENT = "Not compared: libfive, whose package on PyPI holds bindings alone, without the library."


def _batch(terms: Terms, nodes: Floats, first: NDArray[np.intp]) -> Surface:
    """Marching cubes of one batch; vertices in cells of the whole grid."""
    from skimage.measure import marching_cubes

    x, y, z = (nodes[start : start + BATCH + 1] for start in first)
    values = near_linear(terms, x, y, z)
    if not values.min() < 0 < values.max():
        return np.empty((0, 3), np.float32), np.empty((0, 3), np.int32)
    vertices, faces, _, _ = marching_cubes(values, 0.0)
    return vertices + first, faces


def _placed(vertices: NDArray[np.floating], cells: int) -> NDArray[np.floating]:
    """World coordinates of what is given in cells."""
    return vertices * ((HIGH - LOW) / cells) + LOW


def _merged(vertices: NDArray[np.floating], faces: NDArray[np.integer]) -> Surface:
    x, y, z = np.rint((vertices - LOW) * ((1 << _BITS) / (HIGH - LOW))).astype(np.int64).T
    _, first, inverse = np.unique((x << 2 * _BITS) + (y << _BITS) + z, return_index=True, return_inverse=True)
    return vertices[first], inverse[faces]
