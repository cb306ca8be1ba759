"""The preview as the window uses it: drawn only when something changed, refined while nothing does."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hqmodel.gpu import Preview
from hqmodel.model import Scene

from .view import View

if TYPE_CHECKING:
    import moderngl


class Canvas:
    """A picture of the scene in a texture. `unfinished` while further calls of `draw` would make it better."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._preview = Preview(ctx)
        self._scene: Scene | None = None
        self._drawn: object = None
        self.unfinished = True

    def draw(self, scene: Scene, view: View, size: tuple[int, int], moving: bool) -> int:
        """Bring the picture up to date, roughly while things are moving; its texture's name."""
        if scene is not self._scene:
            self._preview.show(scene)
            self._scene, self._drawn = scene, None
        wanted = (view, size)
        changed, self._drawn = wanted != self._drawn, wanted
        if changed or self.unfinished:
            better = self._preview.draw(view.camera, size, view.mode, quick=moving or changed)
            self.unfinished = better or moving or changed
        return int(self._preview.texture.glo)
