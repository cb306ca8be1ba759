"""What a scene is started from: a few shapes everyone knows, made of strips."""

from __future__ import annotations

from hqmodel.model import Group, Scene, Shape, Strip, Vector

# Flat enough to read as a face, round enough at the edges to catch the light.
FLAT = 20.0
PRIMITIVES = ("ball", "block", "cylinder")

_X: Vector = (1.0, 0.0, 0.0)
_Y: Vector = (0.0, 1.0, 0.0)
_Z: Vector = (0.0, 0.0, 1.0)


def new_shape(kind: str, dimension: int = 3) -> Shape:
    """One of the `PRIMITIVES`, half-width 1 each way and centred; in two dimensions its outline.

    A cylinder's outline is a disc, as the ball's is. Raises KeyError for another kind.
    """
    strips = {"ball": _ball, "block": _block, "cylinder": _cylinder}[kind]()
    if dimension == 2:
        strips = tuple(strip for strip in strips if strip.normal[2] == 0)
    groups = {strip.group: Group(gamma=FLAT) for strip in strips if strip.group is not None}
    return Shape(name=kind.capitalize(), strips=strips, groups=groups)


def new_scene() -> Scene:
    """What the modeller shows first: a ball of clay."""
    return Scene(name="Untitled", shapes=(new_shape("ball"),))


def _ball() -> tuple[Strip, ...]:
    return tuple(Strip(normal=normal, gamma=2.0) for normal in (_X, _Y, _Z))


def _block() -> tuple[Strip, ...]:
    return tuple(Strip(normal=normal, gamma=FLAT) for normal in (_X, _Y, _Z))


def _cylinder() -> tuple[Strip, ...]:
    """x and y in a group of inner exponent 2 (eqs. 7, 14)."""
    side = tuple(Strip(normal=normal, gamma=2.0, group="side") for normal in (_X, _Y))
    return (*side, Strip(normal=_Z, gamma=FLAT))
