"""From fitted bodies to a scene that an artist can go on with."""

from __future__ import annotations

import numpy as np

from hqmodel.model import Axis, Group, Scene, Shape, Strip, Transform, Vector, vector

from .bodies import Array, Bodies
from .cloud import Frame

# Colours that parts take in turn, sRGB.
_COLORS: tuple[Vector, ...] = (
    (0.78, 0.55, 0.42),
    (0.53, 0.64, 0.70),
    (0.80, 0.71, 0.47),
    (0.58, 0.67, 0.52),
    (0.69, 0.54, 0.62),
    (0.63, 0.60, 0.56),
)
_GROUP = "group"
_AXES: tuple[Axis, ...] = ("x", "y", "z")


def scene_of(bodies: Bodies, frame: Frame) -> Scene:
    """The scene, in world units, of bodies in a frame: a shape each, its origin in its middle.

    Mirror images are made by the shape's own `mirror` where the plane is one of the world's, else they are shapes themselves.
    """
    axis = frame.mirror_axis
    every = bodies if axis is not None else bodies.images()
    shapes = []
    for k in range(len(every)):
        name = f"part {k + 1}" if len(every) > 1 else "body"
        mirror = (_AXES[axis],) if axis is not None and every.mirrored[k] else ()
        shapes.append(_shape(every, k, frame, name, mirror))
    return Scene(shapes=tuple(shapes))


def _shape(bodies: Bodies, k: int, frame: Frame, name: str, mirror: tuple[Axis, ...]) -> Shape:
    own = bodies.owner == k
    length = np.linalg.norm(bodies.normal[own], axis=1)
    normal = bodies.normal[own] @ frame.rotation / length[:, None]
    half_width = frame.size / length
    offset = bodies.offset[own] * half_width - normal @ frame.centre
    middle = _rounded(_middle(normal, offset, half_width, frame), 1e-6 * frame.size)
    group: list[str | None] = [None] * (len(normal) - bodies.grouped) + [_GROUP] * bodies.grouped
    strips = [
        Strip(normal=vector(_rounded(n, 1e-9)), offset=_short(o), half_width=_short(s), gamma=_short(g, 6), group=its)
        for n, o, s, g, its in zip(normal, offset + normal @ middle, half_width, bodies.own_gamma[own], group, strict=True)
    ]
    return Shape(
        name=name,
        coefficient=float(bodies.sign[k]),
        hardness=_short(bodies.hardness[k], 6),
        color=_COLORS[k % len(_COLORS)],
        mirror=mirror,
        transform=Transform(translation=vector(middle)),
        groups={_GROUP: Group(gamma=_short(bodies.gamma[-2], 6))} if bodies.grouped else {},
        strips=tuple(strips),
    )


def _middle(normal: Array, offset: Array, half_width: Array, frame: Frame) -> Array:
    """Where the strips' middle planes meet, as nearly as they do; no further out than the cloud."""
    planes = np.column_stack([normal, offset]) / half_width[:, None]
    middle = np.linalg.lstsq(planes[:, :3], -planes[:, 3], rcond=1e-3)[0] - frame.centre
    return frame.centre + np.clip(middle, -frame.size / 2, frame.size / 2)


def _rounded(values: Array, step: float) -> Array:
    """To as many decimals as the step has: nobody wants to read more."""
    return np.round(values, max(0, int(np.ceil(-np.log10(step))))) + 0.0


def _short(value: float, digits: int = 10) -> float:
    return float(f"{value:.{digits}g}")
