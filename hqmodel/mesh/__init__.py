"""From the field to triangles, and triangles to files."""

from .build import FEWEST_FACES, MAX_RESOLUTION, USUAL_RESOLUTION, Progress, polygonize
from .formats import write
from .measure import report
from .mesh import Mesh, MeshError, Quads
from .placing import FORMATS, METRES, SIZES, UP_AXIS, fitted, in_world, sized
from .radial import radial_quads
from .room import expected_faces, lack_of_room, must_have_room
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
    "Mesh",
    "MeshError",
    "Progress",
    "Quads",
    "Thin",
    "expected_faces",
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
