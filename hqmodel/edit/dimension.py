"""Between the flat scenes of two dimensions, outlines in the plane z = 0, and solid ones."""

from __future__ import annotations

from hqmodel.model import Scene, Shape, Strip

from .paths import put

# An exponent flat enough to read as a face, round enough at the edges to catch the light.
FLAT = 20.0


def flattened(scene: Scene) -> Scene:
    """Every shape's outline in the plane z = 0: normals lose their z part, strips across z alone go, and shapes of only such."""
    shapes = [flat for flat in map(outline, scene.shapes) if flat is not None]
    return put(put(scene, ("shapes",), shapes), ("dimension",), 2)


def extruded(scene: Scene) -> Scene:
    """The scene with every outline made a solid, by a strip across z of half-width 1."""
    return put(put(scene, ("dimension",), 3), ("shapes",), [_solid(shape) for shape in scene.shapes])


def outline(shape: Shape) -> Shape | None:
    """The shape's section at its own z = 0, for a flat scene; None where no strip is left."""
    strips = [strip.changed(normal=(*strip.normal[:2], 0.0)) for strip in shape.strips if any(strip.normal[:2])]
    if not strips:
        return None
    used = {strip.group for strip in strips}
    gone = {strip.group for strip in shape.strips} - used
    groups = {name: group for name, group in shape.groups.items() if name not in gone}
    return shape.changed(strips=strips, groups=groups)


def _solid(shape: Shape) -> Shape:
    if any(strip.normal[2] for strip in shape.strips):
        return shape
    return shape.changed(strips=(*shape.strips, Strip(normal=(0.0, 0.0, 1.0), gamma=FLAT)))
