"""What is selected: shapes, in the order they were picked, or one strip of the last of them."""

from __future__ import annotations

from dataclasses import dataclass

from hqmodel.model import Scene, Vector

# The signs of the shape itself, among its mirror images.
ITSELF: Vector = (1.0, 1.0, 1.0)


@dataclass(frozen=True)
class Selection:
    """Indices into the scene. The last shape is the active one, whose properties are shown.

    `image` are the signs of the mirror image in which the strip was picked.
    """

    shapes: tuple[int, ...] = ()
    strip: int | None = None
    image: Vector = ITSELF

    @property
    def active(self) -> int | None:
        return self.shapes[-1] if self.shapes else None

    def picked(self, shape: int | None, strip: int | None = None, add: bool = False, image: Vector = ITSELF) -> Selection:
        """After a click on this; with `add` on the same shape again, that one is let go."""
        if shape is None:
            return self if add else Selection()
        if not add:
            return Selection((shape,), strip, image)
        others = tuple(index for index in self.shapes if index != shape)
        return Selection(others) if shape == self.active else Selection((*others, shape), strip, image)

    def chosen(self, shapes: tuple[int, ...], add: bool = False) -> Selection:
        """These shapes; with `add` besides those that were selected."""
        return Selection((*(index for index in self.shapes if add and index not in shapes), *shapes))

    def within(self, scene: Scene) -> Selection:
        """What is left of it in a scene that may have fewer shapes or strips."""
        shapes = tuple(index for index in self.shapes if index < len(scene.shapes))
        if not shapes or shapes[-1] != self.active or self.strip is None:
            return Selection(shapes)
        shape = scene.shapes[shapes[-1]]
        x, y, z = (sign if axis in shape.mirror else 1.0 for axis, sign in zip("xyz", self.image, strict=True))
        return Selection(shapes, self.strip if self.strip < len(shape.strips) else None, (x, y, z))
