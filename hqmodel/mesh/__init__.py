"""From the field to triangles, and triangles to files."""

from .build import FEWEST_FACES, MAX_RESOLUTION, Progress, polygonize
from .formats import write
from .measure import report
from .mesh import Mesh, MeshError, Quads
from .placing import FORMATS, METRES, SIZES, UP_AXIS, fitted, sized
from .radial import radial_quads

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
    "Quads",
    "fitted",
    "polygonize",
    "radial_quads",
    "report",
    "sized",
    "write",
]
