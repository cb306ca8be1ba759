"""From the field to triangles, and triangles to files."""

from .build import FEWEST_FACES, MAX_RESOLUTION, Progress, polygonize
from .formats import write
from .measure import report
from .mesh import Mesh, MeshError
from .placing import FORMATS, METRES, SIZES, UP_AXIS, fitted, sized

__all__ = [
    "FEWEST_FACES",
    "FORMATS",
    "MAX_RESOLUTION",
    "METRES",
    "SIZES",
    "UP_AXIS",
    "Mesh",
    "MeshError",
    "Progress",
    "fitted",
    "polygonize",
    "report",
    "sized",
    "write",
]
