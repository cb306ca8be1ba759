"""Edits as named pure functions from a scene to a new one, and the history that they make."""

from .angles import about, angles, composed, quaternion
from .animation import (
    Animation,
    Sweep,
    add_animation,
    animation_at,
    animations,
    filmed,
    remove_animation,
    set_animation,
    staged,
    sweep_of,
)
from .arranging import carve, move_shapes, repeat_around, scale_shapes, stretch_shapes, turn_shapes
from .cuts import CHOP, PAT, chop, clay_at, pat
from .dimension import extruded, flattened
from .exponents import scale_exponents
from .frames import SHARP, STARTS, frame_of, framed_scene, make_orthonormal, replace_frame, set_frame, turn_frame
from .history import History
from .paths import EditError, get, locations, parse, put, put_fields, reset
from .planes import push_plane, slide_strip, spread_planes, tilt_strip
from .primitives import PRIMITIVES, new_scene, new_shape, prism
from .shapes import add_shape, duplicate_shape, move_shape, remove_shapes, rename_shapes
from .strips import add_strip, duplicate_strip, move_strip, remove_strip, set_group, ungroup

__all__ = [
    "CHOP",
    "PAT",
    "PRIMITIVES",
    "SHARP",
    "STARTS",
    "Animation",
    "EditError",
    "History",
    "Sweep",
    "about",
    "add_animation",
    "add_shape",
    "add_strip",
    "angles",
    "animation_at",
    "animations",
    "carve",
    "chop",
    "clay_at",
    "composed",
    "duplicate_shape",
    "duplicate_strip",
    "extruded",
    "filmed",
    "flattened",
    "frame_of",
    "framed_scene",
    "get",
    "locations",
    "make_orthonormal",
    "move_shape",
    "move_shapes",
    "move_strip",
    "new_scene",
    "new_shape",
    "parse",
    "pat",
    "prism",
    "push_plane",
    "put",
    "put_fields",
    "quaternion",
    "remove_animation",
    "remove_shapes",
    "remove_strip",
    "rename_shapes",
    "repeat_around",
    "replace_frame",
    "reset",
    "scale_exponents",
    "scale_shapes",
    "set_animation",
    "set_frame",
    "set_group",
    "slide_strip",
    "spread_planes",
    "staged",
    "stretch_shapes",
    "sweep_of",
    "tilt_strip",
    "turn_frame",
    "turn_shapes",
    "ungroup",
]
