"""hqmodel render: the preview's picture, without a window."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import Annotated

import typer

from hqmodel.model import VIEWS, Camera, Scene, shown

from .faults import MACHINE, USAGE, Fault
from .options import PLANE_HELP, Json, Preset, Quiet, Set, Slice, plane_of, scene_of
from .outputs import checked, tell, writing
from .progress import progress

LARGEST = 8192

Output = Annotated[Path, typer.Option("-o", "--output", metavar="FILE.png", help="The picture.")]
Size = Annotated[str, typer.Option("--size", metavar="WxH", help="Width and height in pixels.")]
View = Annotated[
    str | None, typer.Option("--view", metavar="|".join(VIEWS), help="A standard view; iso, or top in two dimensions.")
]
Azimuth = Annotated[float | None, typer.Option("--azimuth", metavar="DEGREES", help="From the front (0) to the right (90).")]
Elevation = Annotated[float | None, typer.Option("--elevation", metavar="DEGREES", help="From below (-90) to above (90).")]
Mode = Annotated[
    str, typer.Option("--mode", metavar="MODE", help="clay, porcelain, metal, studio, normals, curvature, strips or depth.")
]

Cut = Annotated[str | None, typer.Option("--cut", metavar="AXIS=D", help=f"Cut the body open by a plane: {PLANE_HELP}")]


def render(
    preset: Preset,
    output: Output,
    size: Size = "1024x768",
    view: View = None,
    azimuth: Azimuth = None,
    elevation: Elevation = None,
    mode: Mode = "clay",
    cut: Cut = None,
    slice_t: Slice = None,
    settings: Set = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Draw the body as the modeller shows it."""
    started = perf_counter()
    width, height = _pixels(size)
    scene = scene_of(preset, slice_t, settings)
    checked([output], [".png"], [preset])
    plane = None if cut is None else plane_of("--cut", cut)
    camera = _camera(scene, view, azimuth, elevation, width / height)
    from hqmodel import gpu  # late: a preset at fault is told at once
    from hqmodel.field import region

    if mode not in gpu.MODES:
        raise Fault(f"--mode: expected {', '.join(gpu.MODES)}, got {shown(mode)}", USAGE)
    try:
        with progress(quiet) as report:
            pixels = gpu.render(scene, camera, (width, height), mode, plane, progress=report)
    except gpu.GpuError as error:
        raise Fault(str(error), MACHINE) from None
    if mode == "curvature":
        pixels = gpu.with_legend(pixels, gpu.Legend.of(region(scene)))
    from PIL import Image

    with writing([output]) as (stream,):
        Image.fromarray(pixels).save(stream, format="png")
    seconds = perf_counter() - started
    result = {"files": [str(output)], "width": width, "height": height, "mode": mode, "seconds": seconds}
    tell(result, f"{output}: {width} x {height} pixels, {seconds:.1f} s", as_json, quiet)


def _pixels(size: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d{1,6})[xX](\d{1,6})", size.strip(), re.ASCII)
    if not match or not all(1 <= int(side) <= LARGEST for side in match.groups()):
        raise Fault(f"--size: expected WxH in pixels, each from 1 to {LARGEST}, got {shown(size)}", USAGE)
    return int(match[1]), int(match[2])


def _camera(scene: Scene, view: str | None, azimuth: float | None, elevation: float | None, aspect: float) -> Camera:
    """A standard view, turned as asked, with the whole body in the picture."""
    from hqmodel.field import region

    if view is not None and view not in VIEWS:
        raise Fault(f"--view: expected {', '.join(VIEWS)}, got {shown(view)}", USAGE)
    camera = Camera().looking(view or ("top" if scene.dimension == 2 else "iso"))
    if azimuth is not None:
        camera = replace(camera, azimuth=_angle("--azimuth", azimuth, 360.0))
    if elevation is not None:
        camera = replace(camera, elevation=_angle("--elevation", elevation, 90.0))
    where = region(scene)
    return camera.framing(where.low, where.high, aspect)


def _angle(option: str, value: float, most: float) -> float:
    if not abs(value) <= most:
        raise Fault(f"{option}: expected degrees from {-most:g} to {most:g}, got {value}", USAGE)
    return value
