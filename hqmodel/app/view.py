"""What the viewport shows and from where, and how a preset remembers it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from math import isfinite
from typing import Any

from hqmodel.model import Camera

MODES = ("clay", "normals", "curvature", "strips", "depth")


@dataclass(frozen=True)
class View:
    """The camera and what the surface is coloured by."""

    camera: Camera = field(default_factory=Camera)
    mode: str = MODES[0]

    def moved(self, camera: Camera) -> View:
        """The same seen from elsewhere."""
        return replace(self, camera=camera)

    def stored(self, before: Mapping[str, Any]) -> dict[str, Any]:
        """The preset's `view` with this view in it; what others keep there stays."""
        return {**before, "camera": asdict(self.camera), "mode": self.mode}


def restored(stored: Mapping[str, Any]) -> View | None:
    """The view a preset remembers, None where it remembers none or nothing that can be used."""
    camera = _camera(stored.get("camera"))
    if camera is None:
        return None
    mode = stored.get("mode")
    return View(camera, mode if mode in MODES else MODES[0])


def _camera(stored: object) -> Camera | None:
    if not isinstance(stored, Mapping):
        return None
    defaults = asdict(Camera())
    known = {key: stored[key] for key in defaults if key in stored}
    target = known.get("target", defaults["target"])
    numbers = [known.get(key, defaults[key]) for key in ("distance", "azimuth", "elevation", "field_of_view")]
    if not isinstance(target, (list, tuple)) or len(target) != 3 or not all(map(_number, [*target, *numbers])):
        return None
    distance, azimuth, elevation, angle = map(float, numbers)
    if not (distance > 0 and abs(elevation) <= 90 and 0 < angle < 180):
        return None
    x, y, z = map(float, target)
    return Camera((x, y, z), distance, azimuth, elevation, angle, known.get("orthographic") is True)


def _number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and isfinite(value)
