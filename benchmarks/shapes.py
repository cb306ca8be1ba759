"""The shapes that benchmarks compare on, each with what makes it hard."""

from __future__ import annotations

from math import sqrt

from hqmodel.model import Scene, Shape, Strip, Transform

_GOLDEN = (1 + sqrt(5)) / 2
_HADAMARD = [(0.5, 0.5, 0.5), (0.5, -0.5, -0.5), (-0.5, 0.5, -0.5), (-0.5, -0.5, 0.5)]
_ICOSAHEDRAL = [(0, 1, _GOLDEN), (0, 1, -_GOLDEN), (1, _GOLDEN, 0), (1, -_GOLDEN, 0), (_GOLDEN, 0, 1), (-_GOLDEN, 0, 1)]


Normals = list[tuple[float, float, float]]


def _lone(normals: Normals, gamma: float, half_width: float = 1.0, rate: float = 0.0, t: float = 0.0) -> Scene:
    strips = tuple(Strip(normal=normal, gamma=gamma, half_width=half_width, slice=rate) for normal in normals)
    return Scene(slice=t, shapes=(Shape(strips=strips),))


def _blended(count: int = 8) -> Scene:
    axes = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
    shapes = []
    for i in range(count):
        place = (((i & 1) - 0.5) * 1.1, ((i >> 1 & 1) - 0.5) * 0.9 + 0.05 * i, ((i >> 2 & 1) - 0.5) * 1.0)
        strips = tuple(Strip(normal=axis, gamma=2.0 + i) for axis in axes)
        transform = Transform(translation=place, scale=(0.5, 0.45, 0.4))
        shapes.append(Shape(hardness=3.0, transform=transform, strips=strips))
    return Scene(shapes=tuple(shapes))


def shapes() -> dict[str, Scene]:
    """The benchmark scenes by name."""
    sides = Strip(normal=(1, 0, 0), gamma=60), Strip(normal=(0, 1, 0), gamma=60)
    thin = (*sides, Strip(normal=(0, 0, 1), gamma=60, half_width=0.02))
    return {
        "tetrahedral, gamma 8": _lone(_HADAMARD, 8.0, rate=0.5, t=0.4),
        "dodecahedral, gamma 40": _lone(_ICOSAHEDRAL, 40.0, half_width=sqrt(1 + _GOLDEN**2)),
        "plate, gamma 60": Scene(shapes=(Shape(strips=thin),)),
        "eight blended": _blended(),
        "astroid, gamma 0.6": _lone([(1, 0, 0), (0, 1, 0), (0, 0, 1)], 0.6),
    }
