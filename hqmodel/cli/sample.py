"""hqmodel sample: the field, its gradient and the curvatures at given points."""

from __future__ import annotations

from pathlib import Path
from time import perf_counter
from typing import Annotated

import numpy as np
import typer

from .options import Json, Preset, Quiet, Set, Slice, scene_of
from .outputs import checked, tell, writing
from .progress import progress
from .table import header_of, rows, text_of

COLUMNS = ("x", "y", "z")
ADDED = ("value", "gradient_x", "gradient_y", "gradient_z", "gaussian_curvature", "mean_curvature")

Points = Annotated[Path, typer.Argument(metavar="POINTS.csv", help="A table with the columns x,y,z.")]
Output = Annotated[Path, typer.Option("-o", "--output", metavar="OUT.csv", help="The table to write.")]


def sample(
    preset: Preset,
    points: Points,
    output: Output,
    slice_t: Slice = None,
    settings: Set = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Evaluate the field and its derivatives at points.

    That is the field F, its gradient, and the Gaussian and mean curvature of the level set through each point.
    """
    started = perf_counter()
    scene = scene_of(preset, slice_t, settings)
    checked([output], (), [preset])
    from hqmodel.field import Terms, curvature, gradient, value

    terms = Terms.of(scene)
    count = 0
    with progress(quiet) as report, writing([output]) as (stream,):
        stream.write(header_of((*COLUMNS, *ADDED)))
        for block in rows(points, COLUMNS):
            at = block.values
            bent = curvature(terms, at)
            stream.write(text_of(np.column_stack([at, value(terms, at), gradient(terms, at), bent.gaussian, bent.mean])))
            count += len(at)
            report(block.share, "Sampling")
    seconds = perf_counter() - started
    result = {"points": count, "seconds": seconds, "files": [str(output)]}
    tell(result, f"{output}: {count:,} points, {seconds:.1f} s", as_json, quiet)
