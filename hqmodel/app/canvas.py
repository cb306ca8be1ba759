"""The preview as the window uses it: drawn only when something changed, refined while nothing does."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Region
from hqmodel.gpu import Legend, Preview, Seen
from hqmodel.model import Scene

from .view import View

if TYPE_CHECKING:
    import moderngl

# A shape and a strip of it.
Lit = tuple[int, int]


class Canvas:
    """A picture of the scene in a texture. `unfinished` while further calls of `draw` would make it better."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._preview = Preview(ctx)
        self._scene: Scene | None = None
        self._hasty = False  # whether the scene is shown as it is while something is dragged
        self._drawn: tuple[View, tuple[int, int]] | None = None
        self._lit: Lit | None = None
        self.unfinished = True

    @property
    def region(self) -> Region:
        """Where the body is that the picture shows."""
        return self._preview.region

    @property
    def legend(self) -> Legend:
        """What the colours of the curvature mode mean."""
        return self._preview.legend()

    def draw(self, scene: Scene, view: View, size: tuple[int, int], budget: float, lit: Lit | None = None) -> int:
        """Bring the picture up to date, by a draft at first and finer in `budget` seconds, if any; its texture's name.

        What the strip `lit` shapes is shown in a warmer tint.
        """
        quick = not budget
        if scene is not self._scene or (self._hasty and not quick):
            self._preview.show(scene, quick)
            self._scene, self._hasty, self._drawn = scene, quick, None
        if self._drawn != (view, size):
            self._preview.draw(view.camera, size, view.mode, True, 0.0, view.cut, lit, view.ghosts)
            self._drawn, self.unfinished = (view, size), True
        elif (budget and self.unfinished) or lit != self._lit:
            self.unfinished = self._preview.draw(view.camera, size, view.mode, quick, budget, view.cut, lit, view.ghosts)
        self._lit = lit
        return int(self._preview.texture.glo)

    def pixels(self) -> NDArray[np.uint8]:
        """The picture as it stands, (height, width, 4), top row first."""
        return self._preview.pixels()

    def pick(self, view: View, size: tuple[int, int], pixel: tuple[int, int]) -> Seen | None:
        """What the picture shows at a pixel, counted from the top left."""
        return self._preview.pick(view.camera, size, pixel, cut=view.cut)
