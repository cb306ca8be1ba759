"""hqmodel fit: a preset from points or a mesh."""

from __future__ import annotations

from pathlib import Path
from time import perf_counter
from typing import Annotated, Any

import typer

from hqmodel.files import save
from hqmodel.model import Scene, shown

from .compare import compared
from .faults import USAGE, Fault, unwritable
from .options import Json, Quiet
from .outputs import checked, tell, writing
from .progress import progress

CloudFile = Annotated[Path, typer.Argument(metavar="CLOUD", help="Points or a mesh: .ply, .obj, .stl, or .xyz lines of x y z.")]
Output = Annotated[Path, typer.Option("-o", "--output", metavar="PRESET", help="The preset to write.")]
Parts = Annotated[str, typer.Option("--parts", metavar="N|auto", help="At most so many bodies.")]
Strips = Annotated[int, typer.Option("--strips", metavar="N", min=3, max=32, help="At most so many strips in a body.")]
Tolerance = Annotated[
    float, typer.Option("--tolerance", metavar="X", help="Distances below this share of the diagonal count as none.")
]
Seed = Annotated[int, typer.Option("--seed", metavar="N", min=0, help="The same seed gives the same preset.")]
Compare = Annotated[
    Path | None, typer.Option("--compare", metavar="FILE.png", help="A picture of the points, coloured by distance, and the fit.")
]


def fit(
    cloud: CloudFile,
    output: Output,
    parts: Parts = "1",
    strips: Strips = 8,
    tolerance: Tolerance = 2e-4,
    seed: Seed = 0,
    compare: Compare = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Fit hyperquadrics to points or a mesh."""
    started = perf_counter()
    bodies = _parts(parts)
    if not 1e-6 <= tolerance <= 0.1:
        raise Fault(f"--tolerance: expected a number from 1e-06 to 0.1, got {tolerance:g}", USAGE)
    checked([output], [".json"], [str(cloud)])
    checked([path for path in (output, compare) if path], [], [str(cloud)])
    checked([compare] if compare else [], [".png"])
    from hqmodel.fit import FitError, read
    from hqmodel.fit import fit as fitted  # late: a command line at fault is told at once

    try:
        points, normals = read(cloud, seed)
        with progress(quiet) as report:
            found = fitted(points, normals, parts=bodies, strips=strips, tolerance=tolerance, seed=seed, progress=report)
    except FitError as error:
        raise Fault(f"{cloud}: {error}") from None
    except OSError as error:
        raise Fault(f"{cloud}: expected a file that can be read, got: {error.strerror or error}") from None
    scene = found.scene.changed(name=cloud.stem, description=_description(cloud, found.report.plain()))
    if compare:
        picture = compared(scene, points, found.residuals, found.report.diagonal, quiet)
        with writing([compare]) as (stream,):
            picture.save(stream, format="png")
    _save(scene, output)
    result = found.report.plain() | {
        "seconds": perf_counter() - started,
        "files": [str(path) for path in (output, compare) if path],
    }
    tell(result, _text(result), as_json, quiet)


def _parts(text: str) -> Any:
    if text == "auto":
        return text
    if not text.isascii() or not text.isdigit() or not 1 <= int(text[:4]) <= 64:
        raise Fault(f"--parts: expected a whole number from 1 to 64 or auto, got {shown(text)}", USAGE)
    return int(text)


def _description(cloud: Path, report: dict[str, Any]) -> str:
    return f"Fitted to {report['points']:,} points of {cloud.name}, half of them within {report['median']:.3%} of the diagonal."


def _save(scene: Scene, output: Path) -> None:
    try:
        save(scene, output)
    except OSError as error:
        raise unwritable(output, error) from None


def _text(result: dict[str, Any]) -> str:
    """The report for people: what was done, then how well it fits."""
    lines = [
        f"  {step['what']}" + (f", criterion {step['gain']:,.0f} lower" if step["gain"] > 0 else "") for step in result["steps"]
    ]
    counts = f"{result['parts']} {'part' if result['parts'] == 1 else 'parts'}, {result['strips']} strips"
    away = "{median:.3%} of the diagonal away (median), {most:.3%} (90 %), {largest:.3%} (largest)".format(**result)
    outliers = f", outliers {result['outliers']:.1%}" if result["outliers"] > 0.005 else ""
    return "\n".join([*lines, f"{', '.join(result['files'])}: {counts}, {away}{outliers}, {result['seconds']:.1f} s"])
