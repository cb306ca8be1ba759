"""What shapes and strips are called on the screen."""

from __future__ import annotations

import re
from collections.abc import Iterable

from hqmodel.model import Shape, Strip


def shape_name(shape: Shape, index: int) -> str:
    return shape.name or f"Shape {index + 1}"


def shared_name(shapes: Iterable[Shape]) -> str:
    """What these are called but for a number at the end; empty where they differ in more than that."""
    stems = {re.sub(r" \d+$", "", shape.name) for shape in shapes}
    return stems.pop() if len(stems) == 1 else ""


def strip_name(strip: Strip, index: int) -> str:
    """Its number, and the axis or the direction it is across."""
    across = _axis(strip) or "(" + ", ".join(f"{part:.2g}" for part in strip.normal) + ")"
    return f"Strip {index + 1}  {across}"


def strip_label(strip: Strip, index: int) -> str:
    """Where there is little room: its number, and the axis it is across, if it is one."""
    return f"Strip {index + 1}  {_axis(strip)}".rstrip()


def _axis(strip: Strip) -> str:
    axes = [axis for axis, part in zip("xyz", strip.normal, strict=True) if part]
    return axes[0] if len(axes) == 1 else ""
