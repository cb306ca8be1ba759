"""Writers of outlines: SVG with true curves, and DXF with polylines for cutters."""

from __future__ import annotations

from collections.abc import Callable
from typing import BinaryIO

import numpy as np

from .contour import Array
from .outline import Outline

# What the header of a DXF file calls a unit ($INSUNITS).
_DXF_UNITS = {"mm": 4, "cm": 5, "m": 6, "in": 1, None: 0}
# The picture's margin, and the line's width, as shares of its longer side; and that side in pixels where there is no unit.
_MARGIN, _LINE, _PIXELS = 0.02, 0.004, 1000


def write(outline: Outline, stream: BinaryIO, ending: str, unit: str | None = None) -> None:
    """Write an outline whose lengths are in that unit (mm, cm, m or in; None for no unit) as one of `ENDINGS`."""
    stream.write(_WRITERS[ending](outline, unit).encode())


def _svg(outline: Outline, unit: str | None) -> str:
    """One path, filled by the even-odd rule; v points up, as it does not in SVG. Metres, which SVG lacks, become millimetres."""
    if unit == "m":
        outline, unit = outline.scaled(1000.0), "mm"
    low, high = outline.bounds
    size = float(np.max(high - low))
    margin = _MARGIN * size
    width, height = high - low + 2 * margin
    shift = np.array([margin - low[0], margin + high[1]])
    steps = outline.tolerance / 10
    chains = " ".join(_path(shift + chain * [1.0, -1.0], steps) for chain in outline.curves)
    shown = (1.0 if unit else _PIXELS / max(width, height)) * np.array([width, height])
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{shown[0]:.7g}{unit or ""}" height="{shown[1]:.7g}{unit or ""}" '
        f'viewBox="0 0 {width:.7g} {height:.7g}">\n'
        f'<path fill="none" stroke="black" stroke-width="{_LINE * size:.3g}" stroke-linejoin="round" fill-rule="evenodd" '
        f'd="{chains}"/>\n</svg>\n'
    )


def _path(chain: Array, step: float) -> str:
    digits = max(0, int(np.ceil(-np.log10(step))))
    start = "M" + _numbers(chain[0, :1], digits)
    return start + "".join("C" + _numbers(curve[1:], digits) for curve in chain) + "Z"


def _numbers(points: Array, digits: int) -> str:
    return " ".join(f"{value + 0.0:.{digits}f}" for value in np.round(points, digits).ravel())


def _dxf(outline: Outline, unit: str | None) -> str:
    """Closed polylines, with the unit named in the header."""
    from trimesh.path import Path2D  # late: it takes most of a second
    from trimesh.path.entities import Line

    entities, points, count = [], [], 0
    for polygon in outline.polygons():
        entities.append(Line([*range(count, count + len(polygon)), count]))
        points.append(polygon)
        count += len(polygon)
    text = Path2D(entities=entities, vertices=np.concatenate(points), process=False).export(file_type="dxf")
    return text.replace("9\n$ACADVER", f"9\n$INSUNITS\n70\n{_DXF_UNITS[unit]}\n9\n$ACADVER", 1)


_WRITERS: dict[str, Callable[[Outline, str | None], str]] = {".svg": _svg, ".dxf": _dxf}
ENDINGS = tuple(_WRITERS)
