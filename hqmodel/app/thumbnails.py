"""Small pictures of the built-in presets, made one by one while there is nothing else to do."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from hqmodel import files
from hqmodel.field import region
from hqmodel.gpu import Preview

from .view import View, restored

if TYPE_CHECKING:
    import moderngl

SIDE = 128


class Thumbnails:
    """Textures by the preset's path. Whoever asks for one that is not there yet puts it next in line."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._textures: dict[Path, moderngl.Texture | None] = {}
        self._wanted: list[Path] = []
        self._preview: Preview | None = None
        self._view = View()

    @property
    def waiting(self) -> bool:
        return bool(self._wanted)

    def texture(self, preset: files.Builtin) -> int | None:
        """The texture's name; None while there is none."""
        if preset.path not in self._textures and preset.path not in self._wanted:
            self._wanted.append(preset.path)
        texture = self._textures.get(preset.path)
        return None if texture is None else int(texture.glo)

    def work(self) -> None:
        """Go on with the next one, for a few hundredths of a second."""
        if not self._wanted:
            return
        path = self._wanted[0]
        if self._preview is None and not self._begin(path):
            self._finish(path, None)
        elif self._preview is not None and not self._preview.draw(self._view.camera, (SIDE, SIDE), self._view.mode):
            self._finish(path, self._copy(self._preview))

    def _begin(self, path: Path) -> bool:
        """False where the preset can't be read; opening it will say why."""
        try:
            scene = files.load(path)
        except files.PresetError:
            return False
        self._preview = Preview(self._ctx)
        self._preview.show(scene)
        box = region(scene)
        view = restored(scene.view) or View()
        self._view = view.moved(view.camera.framing(box.low, box.high))
        return True

    def _copy(self, preview: Preview) -> moderngl.Texture:
        return self._ctx.texture((SIDE, SIDE), 4, preview.pixels()[::-1].tobytes())

    def _finish(self, path: Path, texture: moderngl.Texture | None) -> None:
        self._textures[path] = texture
        self._wanted.remove(path)
        if self._preview is not None:
            self._preview.release()
        self._preview = None
