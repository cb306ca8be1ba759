"""hqmodel render: the preview's picture, without a window."""

from __future__ import annotations

from pathlib import Path
from time import perf_counter
from typing import Annotated

import typer

from hqmodel.model import usual

from .faults import MACHINE, Fault
from .options import PLANE_HELP, Json, Preset, Quiet, Set, Slice, plane_of, scene_of
from .outputs import checked, tell, writing
from .progress import progress
from .views import Azimuth, Elevation, Mode, Size, View, drawable, looking, pixels

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
    plane = None if cut is None else plane_of("--cut", cut)
    camera = looking(usual(scene.dimension), view, azimuth, elevation)
    drawable(mode)
    from hqmodel import gpu  # late: a preset at fault is told at once
    from hqmodel.field import region

    where = region(scene)
    try:
        with progress(quiet) as report:
            framed = camera.framing(where.low, where.high, width / height)
            drawn = gpu.render(scene, framed, (width, height), mode, plane, progress=report, where=where)
    except gpu.GpuError as error:
        raise Fault(str(error), MACHINE) from None
    if mode == "curvature":
        drawn = gpu.with_legend(drawn, gpu.Legend.of(where))
    from PIL import Image

    with writing([output]) as (stream,):
        Image.fromarray(drawn).save(stream, format="png")
    seconds = perf_counter() - started
    result = {"files": [str(output)], "width": width, "height": height, "mode": mode, "seconds": seconds}
    tell(result, f"{output}: {width} x {height} pixels, {seconds:.1f} s", as_json, quiet)
