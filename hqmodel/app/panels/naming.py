"""What shapes and strips are called on the screen."""

from __future__ import annotations

from hqmodel.model import Shape, Strip


def shape_name(shape: Shape, index: int) -> str:
    return shape.name or f"Shape {index + 1}"


def strip_name(strip: Strip, index: int) -> str:
    """Its number, and the axis or the direction it is across."""
    axes = [axis for axis, part in zip("xyz", strip.normal, strict=True) if part]
    across = axes[0] if len(axes) == 1 else "(" + ", ".join(f"{part:.2g}" for part in strip.normal) + ")"
    return f"Strip {index + 1}  {across}"
