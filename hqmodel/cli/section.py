"""hqmodel section: the outline in a plane, for drawing and cutting."""

from __future__ import annotations

from pathlib import Path
from time import perf_counter
from typing import Annotated, Literal

import numpy as np
import typer

from .faults import INPUT, USAGE, Fault
from .options import PLANE_HELP, Json, Preset, Quiet, Set, Slice, plane_of, scene_of
from .outputs import checked, tell, writing

Unit = Literal["mm", "cm", "m", "in"]

Output = Annotated[
    list[Path],
    typer.Option(
        "-o",
        "--output",
        metavar="FILE",
        help="The drawing: .svg with true curves, or .dxf with polylines for cutters. May be repeated.",
        show_default=False,
    ),
]
Plane_ = Annotated[str, typer.Option("--plane", metavar="AXIS=D", help=PLANE_HELP)]
Unit_ = Annotated[Unit | None, typer.Option("--unit", help="The unit that lengths in the file are in.")]
Size = Annotated[float | None, typer.Option("--size", metavar="X", help="The outline's longer side, in that unit.")]


def section(
    preset: Preset,
    output: Output,
    plane: Plane_ = "z=0",
    unit: Unit_ = None,
    size: Size = None,
    slice_t: Slice = None,
    settings: Set = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Write the body's outline in a plane, as .svg or .dxf."""
    started = perf_counter()
    where = plane_of("--plane", plane)
    scene = scene_of(preset, slice_t, settings)
    if size is not None and not 0 < size < np.inf:
        raise Fault(f"--size: expected a number above 0, got {size:g}", USAGE)
    from hqmodel import outline  # late: a preset at fault is told at once

    checked(output, outline.ENDINGS, [preset])
    try:
        drawn = outline.outline(scene, where)
    except outline.OutlineError as error:
        raise Fault(f"{preset}: {error}", INPUT) from None
    low, high = drawn.bounds
    if size is not None:
        drawn = drawn.scaled(size / float(np.max(high - low)))
        low, high = drawn.bounds
    with writing(output) as streams:
        for path, stream in zip(output, streams, strict=True):
            outline.write(drawn, stream, path.suffix.lower(), unit)
    result = {
        "curves": len(drawn.curves),
        "nodes": sum(map(len, drawn.curves)),
        "area": drawn.area,
        "length": drawn.length,
        "bounds": [low.tolist(), high.tolist()],
        "tolerance": drawn.tolerance,
        "seconds": perf_counter() - started,
        "files": [str(path) for path in output],
    }
    sides = " x ".join(f"{side:.4g}" for side in high - low)
    text = f"{', '.join(map(str, output))}: {sides}{f' {unit}' if unit else ''}, {result['curves']} closed curves"
    tell(result, text, as_json, quiet)
