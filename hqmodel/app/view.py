"""What the viewport shows and from where, and how a preset remembers it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from hqmodel.field import Plane
from hqmodel.model import Camera, remembered

MODES = ("clay", "porcelain", "metal", "studio", "normals", "curvature", "strips", "depth")


@dataclass(frozen=True)
class View:
    """The camera and what the surface is coloured by.

    `cut`: the plane of a section view; what is on the side of its normal is not shown. `ghosts`: whether carving shapes are.
    `bands`: whether the strips of a flat scene are.
    """

    camera: Camera = field(default_factory=Camera)
    mode: str = MODES[0]
    cut: Plane | None = None
    ghosts: bool = True
    bands: bool = False

    def moved(self, camera: Camera) -> View:
        """The same seen from elsewhere."""
        return replace(self, camera=camera)

    def stored(self, before: Mapping[str, Any]) -> dict[str, Any]:
        """The preset's `view` with this view in it; what others keep there stays."""
        return {**before, "camera": asdict(self.camera), "mode": self.mode}


def restored(stored: Mapping[str, Any]) -> View | None:
    """The view a preset remembers, None where it remembers none or nothing that can be used."""
    camera = remembered(stored.get("camera"))
    if camera is None:
        return None
    mode = stored.get("mode")
    return View(camera, mode if mode in MODES else MODES[0])
