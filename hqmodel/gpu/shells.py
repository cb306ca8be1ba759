"""Shapes that carve, shown as bodies of their own."""

from __future__ import annotations

from hqmodel.field import Region
from hqmodel.model import Scene

# Endless ones are shown this much further than the body reaches, as a share of it.
_BEYOND = 0.15


def carving(scene: Scene) -> Scene | None:
    """The scene of the visible shapes that carve, each as if it added; None without any."""
    shapes = tuple(
        shape.changed(coefficient=-shape.coefficient) for shape in scene.shapes if shape.visible and shape.coefficient < 0
    )
    return Scene(shapes=shapes, slice=scene.slice, level=scene.level) if shapes else None


def around(region: Region) -> Region:
    """A box somewhat larger than the body's."""
    wider = _BEYOND * region.size
    return Region(region.low - wider, region.high + wider, cut=True)
