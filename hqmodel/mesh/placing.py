"""Size, unit and up-axis: what a file's users expect of numbers that mean nothing in the modeller."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np

from hqmodel.model import Scene

from .build import polygonize
from .mesh import Mesh, MeshError
from .tolerance import COARSE

Unit = Literal["mm", "cm", "m", "in"]
Up = Literal["y", "z"]

# Longest sides that files are written of: what reads them squares them, in float32.
SIZES = 1e-15, 1e15
METRES: dict[str, float] = {"mm": 0.001, "cm": 0.01, "m": 1.0, "in": 0.0254}
FORMATS = {
    ".obj": "Wavefront OBJ",
    ".ply": "Stanford PLY",
    ".stl": "STL for printing",
    ".glb": "Binary glTF",
    ".3mf": "3MF for printing",
}
UP_AXIS: dict[str, Up] = {".obj": "y", ".ply": "z", ".stl": "z", ".glb": "y", ".3mf": "z"}
# Formats whose numbers are in one unit by definition, or, for STL, by custom.
_FILE_UNIT: dict[str, Unit] = {".stl": "mm", ".glb": "m", ".3mf": "mm"}


def sized(mesh: Mesh, size: float | None) -> Mesh:
    """The mesh scaled about the origin so that its longest side is `size`; as it is without one.

    Raises MeshError for a size out of range.
    """
    if size is None:
        return mesh
    if not SIZES[0] <= size <= SIZES[1]:
        raise MeshError(f"size: expected a number from {SIZES[0]:g} to {SIZES[1]:g}, got {size:g}")
    return _scaled(mesh, size / float(np.max(np.ptp(mesh.vertices, axis=0))))


def in_world(scene: Scene, length: float, size: float | None) -> float:
    """What a length in a file is in the modeller, when the body's longest side, by a coarse mesh, is `size` in it."""
    if size is None:
        return length
    return length * float(np.max(np.ptp(polygonize(scene, COARSE, shading=False).vertices, axis=0))) / size


def fitted(mesh: Mesh, suffix: str, unit: Unit | None = None, size: float | None = None, up: Up | None = None) -> Mesh:
    """The mesh as the file format `suffix` wants it: `size` along its longest side in `unit`, turned to the format's up-axis.

    With a unit, one unit of the modeller is one of it, converted where the format has a unit of its own (GLB metres; 3MF and,
    by custom, STL millimetres); without one numbers stay as they are. `up` overrides the format's up-axis.
    """
    mesh = sized(mesh, size)
    if unit is not None and suffix in _FILE_UNIT:
        mesh = _scaled(mesh, METRES[unit] / METRES[_FILE_UNIT[suffix]])
    return _y_up(mesh) if (up or UP_AXIS[suffix]) == "y" else mesh


def _scaled(mesh: Mesh, factor: float) -> Mesh:
    error = None if mesh.surface_error is None else mesh.surface_error * factor
    return replace(mesh, vertices=mesh.vertices * factor, surface_error=error)


def _y_up(mesh: Mesh) -> Mesh:
    """Turned from z up to y up: what was front faces +z."""
    order, signs = [0, 2, 1], np.array([1, 1, -1], dtype=np.float32)
    normals = None if mesh.normals is None else mesh.normals[:, order] * signs
    return replace(mesh, vertices=mesh.vertices[:, order] * signs + 0.0, normals=normals)
