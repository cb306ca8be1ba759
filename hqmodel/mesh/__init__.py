"""From the field to triangles, and triangles to files."""

from .measure import report
from .mesh import Mesh, MeshError
from .build import MAX_RESOLUTION, polygonize

__all__ = ["MAX_RESOLUTION", "Mesh", "MeshError", "polygonize", "report"]
