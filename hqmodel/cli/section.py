"""hqmodel section: the outline in a plane, for drawing and cutting."""

from __future__ import annotations

from pathlib import Path
from time import perf_counter
from typing import Annotated, Literal

import numpy as np
import typer

from hqmodel.model import shown

from .faults import INPUT, USAGE, Fault
from .options import NUMBER, Json, Preset, Quiet, Set, Slice, scene_of
from .outputs import checked, tell, writing

Unit = Literal["mm", "cm", "m", "in"]
_AXES = {"x": "1,0,0", "y": "0,1,0", "z": "0,0,1"}

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
Plane_ = Annotated[str, typer.Option("--plane", metavar="AXIS=D", help="x=D, y=D or z=D, or A,B,C=D for Ax + By + Cz = D.")]
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
    where = _plane_of(plane)
    scene = scene_of(preset, slice_t, settings)
    if size is not None and not 0 < size < np.inf:
        raise Fault(f"--size: expected a number above 0, got {size:g}", USAGE)
    from hqmodel import outline  # late: a preset at fault is told at once

    checked(output, outline.ENDINGS, [preset])
    try:
        drawn = outline.outline(scene, outline.Plane(*where))
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


def _plane_of(text: str) -> tuple[tuple[float, float, float], float]:
    """The normal, towards the eye, and the offset of a plane."""
    left, equals, right = (part.strip() for part in text.partition("="))
    numbers = [part.strip() for part in _AXES.get(left, left).split(",")]
    if equals and len(numbers) == 3 and all(map(NUMBER.fullmatch, [*numbers, right])):
        sign = -1.0 if left == "y" else 1.0  # seen from the front
        x, y, z, offset = (sign * float(number) for number in (*numbers, right))
        if np.all(np.isfinite([x, y, z, offset])) and (x or y or z):
            return (x, y, z), offset
    raise Fault(f"--plane: expected a plane such as z=0.2 or 1,0,-1=0.5, got {shown(text)}", USAGE)
