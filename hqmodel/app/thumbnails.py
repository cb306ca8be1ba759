"""Small pictures of presets, made one by one while there is nothing else to do, and kept between runs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

import hqmodel
from hqmodel import files
from hqmodel.gpu import Preview
from hqmodel.model import usual

from .view import View, restored

if TYPE_CHECKING:
    import moderngl

SIDE = 128
# A file, and when it was written.
Wanted = tuple[Path, int]


class Thumbnails:
    """Textures by the preset's path and age. Whoever asks for one that is not there yet puts it next in line."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._kept = files.Pictures(hqmodel.__version__)
        self._textures: dict[Wanted, moderngl.Texture | None] = {}
        self._wanted: list[Wanted] = []
        self._data = b""
        self._preview: Preview | None = None
        self._view = View()

    @property
    def waiting(self) -> bool:
        return bool(self._wanted)

    def texture(self, path: Path) -> int | None:
        """The texture's name; None while there is none."""
        try:
            wanted = path, path.stat().st_mtime_ns
        except OSError:
            return None
        if wanted not in self._textures and wanted not in self._wanted:
            self._wanted.append(wanted)
        texture = self._textures.get(wanted)
        return None if texture is None else int(texture.glo)

    def work(self) -> None:
        """Go on with the next one, for a few hundredths of a second."""
        if not self._wanted:
            return
        if self._preview is None:
            self._begin(self._wanted[0][0])
        elif not self._preview.draw(self._view.camera, (SIDE, SIDE), self._view.mode):
            pixels = self._preview.pixels()
            self._kept.keep(self._data, pixels)
            self._finish(pixels)

    def _begin(self, path: Path) -> None:
        """The picture that was kept, or the beginning of one; none where the preset can't be read: opening it will say why."""
        try:
            scene = files.load(path)
            self._data = path.read_bytes()
        except (OSError, files.PresetError):
            self._finish(None)
            return
        kept = self._kept.find(self._data)
        if kept is not None and kept.shape[:2] == (SIDE, SIDE):
            self._finish(kept)
            return
        self._preview = Preview(self._ctx)
        self._preview.show(scene)
        box = self._preview.region
        view = restored(scene.view) or View(usual(scene.dimension))
        self._view = view.moved(view.camera.framing(box.low, box.high))

    def _finish(self, pixels: NDArray[np.uint8] | None) -> None:
        """`pixels` (SIDE, SIDE, 4), the top row first."""
        wanted = self._wanted.pop(0)
        for stale in [key for key in self._textures if key[0] == wanted[0]]:
            texture = self._textures.pop(stale)
            if texture is not None:
                texture.release()
        self._textures[wanted] = None if pixels is None else self._ctx.texture((SIDE, SIDE), 4, pixels[::-1].tobytes())
        if self._preview is not None:
            self._preview.release()
        self._preview = None
