"""From the field to triangles, and triangles to files."""

from .build import FEWEST_FACES, MAX_RESOLUTION, USUAL_RESOLUTION, Progress, polygonize
from .formats import write
from .measure import report
from .mesh import Mesh, MeshError, Quads
from .placing import FORMATS, METRES, SIZES, UP_AXIS, fitted, in_world, sized
from .radial import radial_quads
from .room import Count, lack_of_room, must_have_room
from .thin import Thin, thin_parts
from .tolerance import COARSE, Bending, finer

__all__ = [
    "COARSE",
    "FEWEST_FACES",
    "FORMATS",
    "MAX_RESOLUTION",
    "METRES",
    "SIZES",
    "UP_AXIS",
    "USUAL_RESOLUTION",
    "Bending",
    "Count",
    "Mesh",
    "MeshError",
    "Progress",
    "Quads",
    "Thin",
    "finer",
    "fitted",
    "in_world",
    "lack_of_room",
    "must_have_room",
    "polygonize",
    "radial_quads",
    "report",
    "sized",
    "thin_parts",
    "write",
]
