"""hqmodel new: a preset from an orthonormal frame."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from hqmodel.edit import SHARP, STARTS, frame_of, framed_scene
from hqmodel.field import FEWEST_TERMS, frame_residual, slice_range
from hqmodel.files import dumps
from hqmodel.model import FIELDS, MAX_STRIPS, shown

from .faults import USAGE, Fault
from .options import Json, Quiet, Slice, adjusted
from .outputs import checked, tell, writing

Frame = Annotated[str, typer.Option("--frame", metavar="NAME", help=f"One of {', '.join(STARTS)}.", show_default=False)]
Output = Annotated[Path, typer.Option("-o", "--output", metavar="PRESET", help="The preset to write.", show_default=False)]
Gamma = Annotated[float, typer.Option("--gamma", metavar="G", help="Every strip's exponent: 1 for a cross-polytope's slice.")]
Terms = Annotated[
    int, typer.Option("--terms", metavar="N", min=FEWEST_TERMS, max=MAX_STRIPS, help="How many strips hypercube or random has.")
]
Seed = Annotated[int, typer.Option("--seed", metavar="S", min=0, help="The same seed gives the same random frame.")]


def new(
    frame: Frame,
    output: Output,
    gamma: Gamma = SHARP,
    slice_t: Slice = None,
    terms: Terms = 6,
    seed: Seed = 0,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Write a preset: a slice through a higher-dimensional shape.

    Among them are all regular polyhedra and the semi-regular ones but the two snub ones.
    """
    if frame not in STARTS:
        raise Fault(f"--frame: expected one of {', '.join(STARTS)}, got {shown(frame)}", USAGE)
    exponent = FIELDS["shapes[].strips[].gamma"]
    if not exponent.permits(gamma):
        raise Fault(f"--gamma: expected {exponent.expected()}, got {gamma:g}", USAGE)
    checked([output], [".json"])
    scene = adjusted(framed_scene(frame, gamma, terms, seed), slice_t, None)
    with writing([output]) as (stream,):
        stream.write(dumps(scene).encode())
    extent = slice_range(scene)
    result = {
        "frame": frame,
        "strips": scene.strip_count,
        "gamma": gamma,
        "slice": scene.slice,
        "slice_range": extent,
        "frame_residual": frame_residual(frame_of(scene, 0)),
        "files": [str(output)],
    }
    moves = f", t from {extent[0]:.4g} to {extent[1]:.4g}" if extent else ""
    tell(result, f"{output}: {frame}, {scene.strip_count} strips, gamma {gamma:g}, t = {scene.slice:g}{moves}", as_json, quiet)
