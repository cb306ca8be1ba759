"""What a scene is started from: a few shapes everyone knows, made of strips."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, sin, sqrt

from hqmodel.model import Group, Scene, Shape, Strip, Vector

from .dimension import FLAT, outline

GOLDEN = (1 + sqrt(5)) / 2

_X: Vector = (1.0, 0.0, 0.0)
_Y: Vector = (0.0, 1.0, 0.0)
_Z: Vector = (0.0, 0.0, 1.0)
# From the middle to a face where the corners are at distance 1: the same for both, as they are each other's duals.
_DUAL = sqrt((5 + 2 * sqrt(5)) / 15)
_LEAN = 0.4  # radians that a taper's sides lean in by


def new_shape(kind: str, dimension: int = 3) -> Shape:
    """One of the `PRIMITIVES`, about 1 each way and centred; in two dimensions its section at half height.

    Raises KeyError for another kind.
    """
    strips = _MADE[kind]()
    groups = {strip.group: Group(gamma=FLAT) for strip in strips if strip.group is not None}
    shape = Shape(name=kind.capitalize(), strips=strips, groups=groups)
    return shape if dimension == 3 else outline(shape) or shape


def new_scene() -> Scene:
    """What the modeller shows first: a ball of clay."""
    return Scene(name="Untitled", shapes=(new_shape("ball"),))


def prism(sides: int) -> Shape:
    """An upright prism over a regular polygon of so many sides, 3 at least, one of its sides to the front."""
    return Shape(name=f"Prism of {sides}", strips=_prism(sides))


def _ball() -> tuple[Strip, ...]:
    return tuple(Strip(normal=normal, gamma=2.0) for normal in (_X, _Y, _Z))


def _block() -> tuple[Strip, ...]:
    return tuple(Strip(normal=normal, gamma=FLAT) for normal in (_X, _Y, _Z))


def _cylinder() -> tuple[Strip, ...]:
    """x and y in a group of inner exponent 2 (eqs. 7, 14)."""
    side = tuple(Strip(normal=normal, gamma=2.0, group="side") for normal in (_X, _Y))
    return (*side, Strip(normal=_Z, gamma=FLAT))


def _prism(sides: int) -> tuple[Strip, ...]:
    """Each strip has two of the sides; of an odd number one, its other plane through the corner across."""
    even = sides % 2 == 0
    turns = [-pi / 2 + 2 * pi * k / sides for k in range(sides // 2 if even else sides)]
    near = cos(pi / sides)
    far = near if even else 1.0
    around = tuple(_between((_round(cos(a)), _round(sin(a)), 0.0), near, far) for a in turns)
    return (*around, Strip(normal=_Z, gamma=FLAT))


def _taper() -> tuple[Strip, ...]:
    """Eight sides that lean in towards the top, round enough for a cone; each strip's other plane is out of the way."""
    turns = [2 * pi * k / 8 for k in range(8)]
    sides = [(_round(cos(a) * cos(_LEAN)), _round(sin(a) * cos(_LEAN)), _round(sin(_LEAN))) for a in turns]
    return (*(_between(normal, 0.68, 2.4, 8.0) for normal in sides), Strip(normal=_Z, gamma=FLAT))


def _tetrahedron() -> tuple[Strip, ...]:
    """Each face's strip ends at the corner across (eq. 20 at the slice where the tetrahedron is)."""
    inner = 1 / 3
    corners = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    return tuple(_between(_unit((-x, -y, -z)), inner, 3 * inner) for x, y, z in corners)


def _octahedron() -> tuple[Strip, ...]:
    return tuple(_between(_unit(normal), 1 / sqrt(3), 1 / sqrt(3)) for normal in [(1, 1, 1), (-1, 1, 1), (1, -1, 1), (1, 1, -1)])


def _dodecahedron() -> tuple[Strip, ...]:
    """Its six strips lie across the icosahedron's six axes."""
    pairs = [(0.0, 1.0, sign * GOLDEN) for sign in (1, -1)]
    normals = [turned for pair in pairs for turned in _cyclic(pair)]
    return tuple(_between(_unit(normal), _DUAL, _DUAL) for normal in normals)


def _icosahedron() -> tuple[Strip, ...]:
    """Its ten strips lie across the dodecahedron's ten axes."""
    pairs = [(0.0, 1 / GOLDEN, sign * GOLDEN) for sign in (1, -1)]
    corners = [(1.0, 1.0, 1.0), (-1.0, 1.0, 1.0), (1.0, -1.0, 1.0), (1.0, 1.0, -1.0)]
    normals = [*corners, *(turned for pair in pairs for turned in _cyclic(pair))]
    return tuple(_between(_unit(normal), _DUAL, _DUAL) for normal in normals)


def _between(normal: Vector, near: float, far: float, gamma: float = FLAT) -> Strip:
    """A strip with one plane at normal . p = near and the other at -far."""
    return Strip(normal=normal, half_width=(near + far) / 2, offset=(far - near) / 2 + 0.0, gamma=gamma)


def _cyclic(vector: Vector) -> list[Vector]:
    """The vector and what its components give when they move on."""
    x, y, z = vector
    return [(x, y, z), (y, z, x), (z, x, y)]


def _unit(vector: Vector) -> Vector:
    x, y, z = vector
    length = sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


def _round(value: float) -> float:
    """Without the last digits' noise: cos(pi / 2) is 0."""
    return round(value, 15) + 0.0


_MADE: dict[str, Callable[[], tuple[Strip, ...]]] = {
    "ball": _ball,
    "block": _block,
    "cylinder": _cylinder,
    "taper": _taper,
    "prism": lambda: _prism(6),
    "tetrahedron": _tetrahedron,
    "octahedron": _octahedron,
    "dodecahedron": _dodecahedron,
    "icosahedron": _icosahedron,
}
PRIMITIVES = tuple(_MADE)
