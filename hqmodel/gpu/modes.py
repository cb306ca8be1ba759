"""What a picture can show: the body in one of four materials, or one of its properties as colour."""

from __future__ import annotations

# Flat light on bright ground is `studio`; what `strips` and `curvature` mean is in surface.frag.
MATERIALS = ("clay", "porcelain", "metal", "studio")
MODES = (*MATERIALS, "normals", "curvature", "strips", "depth")


def glsl() -> str:
    """The modes' numbers for the shaders: ``#include "modes.glsl"``."""
    lines = [f"const int MODE_{mode.upper()} = {number};" for number, mode in enumerate(MODES)]
    return "\n".join([*lines, "uniform int mode;", ""])
