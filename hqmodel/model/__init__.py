"""What a scene is: frozen, validated values and the table of their numeric fields. Imports nothing of ours."""

from .camera import VIEWS, Camera, remembered, usual
from .faults import faults
from .fields import FIELDS, MAX_SHAPES, MAX_STRIPS, Number, pattern, place, shown
from .scene import FORMAT, VERSION, Axis, Group, Scene, Shape, Strip, Transform, Value, Vector, unused_name, vector

__all__ = [
    "FIELDS",
    "FORMAT",
    "MAX_SHAPES",
    "MAX_STRIPS",
    "VERSION",
    "VIEWS",
    "Axis",
    "Camera",
    "Group",
    "Number",
    "Scene",
    "Shape",
    "Strip",
    "Transform",
    "Value",
    "Vector",
    "faults",
    "pattern",
    "place",
    "remembered",
    "shown",
    "unused_name",
    "usual",
    "vector",
]
