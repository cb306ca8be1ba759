"""hqmodel render: the preview's picture, without a window."""

from __future__ import annotations

from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated

import typer

from hqmodel.model import Camera, Scene, usual

from .faults import MACHINE, USAGE, Fault
from .options import PLANE_HELP, Json, Preset, Quiet, Set, Slice, plane_of, scene_of
from .outputs import checked, tell, writing
from .progress import progress
from .views import MODE_HELP, Azimuth, Elevation, Size, View, drawable, looking, pixels

if TYPE_CHECKING:
    from PIL import Image

    from hqmodel.field import Plane

Angles = tuple[float | None, float | None]
# The one picture that is not of the body: a flat scene's sum of exponentials as hills (figures 16-18).
LANDSCAPE = "landscape"
Mode = Annotated[
    str,
    typer.Option("--mode", metavar="MODE", help=f"{MODE_HELP} Of a flat preset, landscape: its sum as hills, cut at its level."),
]
Output = Annotated[Path, typer.Option("-o", "--output", metavar="FILE.png", help="The picture.")]
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
    width, height = pixels(size)
    scene = scene_of(preset, slice_t, settings)
    checked([output], [".png"], [preset])
    if mode == LANDSCAPE:
        if cut is not None:
            raise Fault("--cut: expected another --mode with it than landscape", USAGE)
        picture = _landscape(scene, view, (azimuth, elevation), (width, height))
    else:
        plane = None if cut is None else plane_of("--cut", cut)
        camera = looking(usual(scene.dimension), view, azimuth, elevation)
        drawable(mode, LANDSCAPE)
        picture = _body(scene, camera, (width, height), mode, plane, quiet)
    with writing([output]) as (stream,):
        picture.save(stream, format="png")
    seconds = perf_counter() - started
    result = {"files": [str(output)], "width": width, "height": height, "mode": mode, "seconds": seconds}
    tell(result, f"{output}: {width} x {height} pixels, {seconds:.1f} s", as_json, quiet)


def _body(scene: Scene, camera: Camera, size: tuple[int, int], mode: str, plane: Plane | None, quiet: bool) -> Image.Image:
    from PIL import Image

    from hqmodel import gpu  # late: a preset at fault is told at once
    from hqmodel.field import region

    where = region(scene)
    try:
        with progress(quiet) as report:
            framed = camera.framing(where.low, where.high, size[0] / size[1])
            drawn = gpu.render(scene, framed, size, mode, plane, progress=report, where=where)
    except gpu.GpuError as error:
        raise Fault(str(error), MACHINE) from None
    return Image.fromarray(gpu.with_legend(drawn, gpu.Legend.of(where)) if mode == "curvature" else drawn)


def _landscape(scene: Scene, view: str | None, angles: Angles, size: tuple[int, int]) -> Image.Image:
    """The hills of a flat scene and the level plane through them; Fault for a solid one."""
    from hqmodel.outline import OutlineError, outline

    from .plates.landscape import LARGEST, VIEW, draw_landscape, land_of

    if scene.dimension == 3:
        raise Fault("--mode: expected another one than landscape for a solid preset", USAGE)
    if max(size) > LARGEST:
        raise Fault(f"--size: expected at most {LARGEST} pixels either way with --mode landscape, got {max(size)}", USAGE)
    camera = looking(VIEW, view, *angles)
    if camera.elevation < 0:
        raise Fault(f"--elevation: expected 0 or more with --mode landscape, got {camera.elevation:g}", USAGE)
    try:
        section = outline(scene)
    except OutlineError:  # the level plane lies above all hills, or below all land
        section = None
    return draw_landscape(land_of(scene), scene.level, section, size, camera)
