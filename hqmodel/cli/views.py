"""The options of pictures: their size, where the body is seen from, and what its colours show."""

from __future__ import annotations

import re
from dataclasses import replace
from math import sqrt
from typing import Annotated

import typer

from hqmodel import memory
from hqmodel.model import VIEWS, Camera, shown

from .faults import USAGE, Fault

LARGEST = 8192
# Bytes that a picture wants at the most for each pixel, while it is drawn and written.
_PIXEL = 40.0

Size = Annotated[str, typer.Option("--size", metavar="WxH", help="Width and height in pixels.")]
View = Annotated[
    str | None, typer.Option("--view", metavar="|".join(VIEWS), help="A standard view; iso, or top in two dimensions.")
]
Azimuth = Annotated[float | None, typer.Option("--azimuth", metavar="DEGREES", help="From the front (0) to the right (90).")]
Elevation = Annotated[float | None, typer.Option("--elevation", metavar="DEGREES", help="From below (-90) to above (90).")]
MODE_HELP = "clay, porcelain, metal, studio, normals, curvature, strips or depth."
Mode = Annotated[str, typer.Option("--mode", metavar="MODE", help=MODE_HELP)]


def pixels(size: str) -> tuple[int, int]:
    """The width and height that --size means; Fault for what is no size."""
    match = re.fullmatch(r"(\d{1,6})[xX](\d{1,6})", size.strip(), re.ASCII)
    if not match or not all(1 <= int(side) <= LARGEST for side in match.groups()):
        raise Fault(f"--size: expected WxH in pixels, each from 1 to {LARGEST}, got {shown(size)}", USAGE)
    width, height = int(match[1]), int(match[2])
    free, needed = memory.available(), _PIXEL * width * height
    if needed > free:
        share = sqrt(free / needed)
        told = f"expected at most {int(share * width)}x{int(share * height)} in the {memory.told(free)} of memory that are free"
        raise Fault(f"--size: {told}, got {shown(size)}, which needs about {memory.told(needed)}")
    return width, height


def looking(camera: Camera, view: str | None, azimuth: float | None, elevation: float | None) -> Camera:
    """The camera turned to a standard view, where one is named, and by the angles; Fault when they are at fault."""
    if view is not None:
        if view not in VIEWS:
            raise Fault(f"--view: expected {', '.join(VIEWS)}, got {shown(view)}", USAGE)
        camera = camera.looking(view)
    if azimuth is not None:
        camera = replace(camera, azimuth=_angle("--azimuth", azimuth, 360.0))
    if elevation is not None:
        camera = replace(camera, elevation=_angle("--elevation", elevation, 90.0))
    return camera


def drawable(mode: str, *more: str) -> None:
    """Fault for what is no mode of drawing; there may be more than the preview's own."""
    from hqmodel import gpu  # late: a preset at fault is told at once

    if mode not in gpu.MODES:
        raise Fault(f"--mode: expected {', '.join((*gpu.MODES, *more))}, got {shown(mode)}", USAGE)


def _angle(option: str, value: float, most: float) -> float:
    if not abs(value) <= most:
        raise Fault(f"{option}: expected degrees from {-most:g} to {most:g}, got {value}", USAGE)
    return value
