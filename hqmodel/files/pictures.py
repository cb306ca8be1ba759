"""Small pictures of presets, kept between runs under what the preset's file holds and the version that drew it."""

from __future__ import annotations

from hashlib import sha256
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from platformdirs import user_cache_path

from .atomic import atomic

# So many are kept, those longest unused going first.
PICTURES = 400

Pixels = NDArray[np.uint8]


class Pictures:
    """Pictures (height, width, 4) by the bytes of a preset; those of another version are never found."""

    def __init__(self, version: str) -> None:
        self._version = version
        self._folder = user_cache_path("hqmodel", appauthor=False) / "thumbnails"

    def find(self, preset: bytes) -> Pixels | None:
        """The picture of a preset's file, if there is one that can be read."""
        from PIL import Image

        path = self._path(preset)
        try:
            with Image.open(path) as image:
                pixels = np.array(image.convert("RGBA"))
            path.touch()
        except (OSError, ValueError, SyntaxError):  # Pillow's words for damaged files
            return None
        return pixels

    def keep(self, preset: bytes, pixels: Pixels) -> None:
        """Keep one, where the system lets us; it is drawn anew else."""
        from PIL import Image

        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            with atomic(self._path(preset)) as stream:
                Image.fromarray(pixels).save(stream, "png")
            for old in sorted(self._folder.iterdir(), key=lambda path: path.stat().st_mtime_ns, reverse=True)[PICTURES:]:
                old.unlink()
        except OSError:
            return

    def _path(self, preset: bytes) -> Path:
        return self._folder / f"{sha256(self._version.encode() + preset).hexdigest()}.png"
