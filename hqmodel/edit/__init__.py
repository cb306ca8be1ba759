"""Edits as named pure functions from a scene to a new one, and the history that they make."""

from .angles import angles, quaternion
from .dimension import extruded, flattened
from .history import History
from .paths import EditError, get, locations, parse, put, reset
from .primitives import PRIMITIVES, new_scene, new_shape
from .shapes import add_shape, duplicate_shape, move_shape, remove_shapes
from .strips import add_strip, duplicate_strip, move_strip, remove_strip, set_group, ungroup

__all__ = [
    "PRIMITIVES",
    "EditError",
    "History",
    "add_shape",
    "add_strip",
    "angles",
    "duplicate_shape",
    "duplicate_strip",
    "extruded",
    "flattened",
    "get",
    "locations",
    "move_shape",
    "move_strip",
    "new_scene",
    "new_shape",
    "parse",
    "put",
    "quaternion",
    "remove_shapes",
    "remove_strip",
    "reset",
    "set_group",
    "ungroup",
]
