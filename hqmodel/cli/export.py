"""hqmodel export: the body as a triangle mesh."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from dataclasses import replace
from math import inf, nan
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from hqmodel.model import Scene, shown

from .faults import INPUT, USAGE, Fault
from .options import NUMBER, Json, Preset, Quiet, Set, Slice, scene_of
from .outputs import checked, tell, writing
from .progress import progress

if TYPE_CHECKING:
    from hqmodel.mesh import Thin

Unit = Literal["mm", "cm", "m", "in"]
Up = Literal["z", "y"]
Method = Literal["cubes", "radial"]
Output = Annotated[
    list[Path],
    typer.Option(
        "-o", "--output", metavar="FILE", help="The mesh file; its ending says the format. May be repeated.", show_default=False
    ),
]
Resolution = Annotated[
    int | None,
    typer.Option(
        "--resolution",
        metavar="N",
        min=4,
        max=2048,
        help="Cells along the longest side, 256 or as a tolerance asks for; radial: quads round it.",
    ),
]
Method_ = Annotated[
    Method, typer.Option("--method", help="Marching cubes, or a radial grid: quads with texture coordinates, in .obj.")
]
TargetFaces = Annotated[
    int | None, typer.Option("--target-faces", metavar="N", min=4, help="Reduce the mesh to at most so many triangles.")
]
Tolerance = Annotated[
    str | None,
    typer.Option(
        "--tolerance",
        metavar="LENGTH",
        help="As few triangles as lie within that length of the true surface, as 0.1 or, with --unit, 0.1mm.",
    ),
]
Unit_ = Annotated[Unit | None, typer.Option("--unit", help="The unit that lengths in the file are in.")]
Size = Annotated[float | None, typer.Option("--size", metavar="X", help="The longest side, in that unit.")]
Up_ = Annotated[Up | None, typer.Option("--up", help="The axis that points up; by default what the format's users expect.")]
Colors = Annotated[bool, typer.Option("--colors/--no-colors", help="Vertex colours, where the format has them.")]
Normals = Annotated[bool, typer.Option("--normals/--no-normals", help="Vertex normals, where the format has them.")]


def export(
    preset: Preset,
    output: Output,
    resolution: Resolution = None,
    method: Method_ = "cubes",
    target_faces: TargetFaces = None,
    tolerance: Tolerance = None,
    unit: Unit_ = None,
    size: Size = None,
    up: Up_ = None,
    colors: Colors = True,
    normals: Normals = True,
    slice_t: Slice = None,
    settings: Set = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Write the body as a mesh.

    The ending says the format: .obj, .ply, .stl, .glb or .3mf. Several -o write several files from one mesh.
    """
    started = perf_counter()
    scene = scene_of(preset, slice_t, settings)
    from hqmodel import mesh  # late: a preset at fault is told at once

    if size is not None and not mesh.SIZES[0] <= size <= mesh.SIZES[1]:
        raise Fault(f"--size: expected a number from {mesh.SIZES[0]:g} to {mesh.SIZES[1]:g}, got {size:g}", USAGE)
    for option, wanted in (("--target-faces", target_faces), ("--tolerance", tolerance)):
        if method == "radial" and wanted is not None:
            raise Fault(f"{option}: expected --method cubes with it, got radial", USAGE)
    if target_faces is not None and tolerance is not None:
        raise Fault("--tolerance: expected no --target-faces beside it, got both", USAGE)
    length = None if tolerance is None else _length(tolerance, unit)
    checked(output, mesh.FORMATS, [preset])
    try:
        with progress(quiet) as report:
            if method == "radial":
                made = mesh.radial_quads(scene, resolution or mesh.USUAL_RESOLUTION, report)
            else:
                mesh.must_have_room(scene, resolution or mesh.USUAL_RESOLUTION, target_faces is not None or length is not None)
                most = None if length is None else mesh.in_world(scene, length, size)
                made = mesh.polygonize(scene, resolution, report, target_faces=target_faces, tolerance=most)
            body = mesh.sized(made, size)
        result = mesh.report(body)
        shaded = replace(body, colors=body.colors if colors else None, normals=body.normals if normals else None)
        with writing(output) as streams:
            for path, stream in zip(output, streams, strict=True):
                suffix = path.suffix.lower()
                mesh.write(mesh.fitted(shaded, suffix, unit=unit, up=up), stream, suffix, scene.name)
    except mesh.MeshError as error:
        raise Fault(f"{preset}: {error}", INPUT) from None
    result |= {"method": method, "quads": len(body.quads.corners) if body.quads else 0, "resolution": made.resolution}
    thin = mesh.thin_parts(scene, result["resolution"]) if method == "cubes" else []
    result |= {"thin_parts": [f"shapes[{part.shape}]" for part in thin]}
    result |= {"tolerance": length, "seconds": perf_counter() - started, "files": [str(path) for path in output]}
    for warning in [] if quiet else _warnings(result, scene, thin):
        print(f"{preset}: {warning}", file=sys.stderr)
    tell(result, _text(result), as_json, quiet)


def _length(text: str, unit: Unit | None) -> float:
    """The length, in the file's unit, that --tolerance means; Fault for what is none."""
    match = re.fullmatch(rf"(?P<number>{NUMBER.pattern}) ?(?P<unit>mm|cm|m|in)?", text.strip(), NUMBER.flags)
    length = float(match["number"]) if match else nan
    if match is None or not 0 < length < inf:
        raise Fault(f"--tolerance: expected a length above 0 such as 0.1 or 0.1mm, got {shown(text)}", USAGE)
    if match["unit"] is None:
        return length
    if unit is None:
        raise Fault(f"--tolerance: expected --unit beside it, as lengths in the file have none, got {shown(text)}", USAGE)
    from hqmodel.mesh import METRES

    return length * METRES[match["unit"].lower()] / METRES[unit]


def _warnings(result: dict[str, Any], scene: Scene, thin: list[Thin]) -> Iterator[str]:
    """What is not as it was wanted, a line each: parts that the grid saw only some of, a tolerance that was not met."""
    from hqmodel.mesh import finer

    cells, error, length = result["resolution"], result["surface_error"], result["tolerance"]
    for shape, needed in thin:
        name = f"shapes[{shape}] ({scene.shapes[shape].name})"
        yield f"{name}: expected a part no thinner than the cells, got one that is not seen whole at {cells}; {_would(needed)}"
    if length is not None and error > length:
        got = f"--tolerance: expected no point further off than {length:g}, got {error:.2g} at a resolution of {cells}"
        yield f"{got}; {_would(finer(cells, error, length))}"


def _would(needed: int) -> str:
    from hqmodel.mesh import MAX_RESOLUTION

    return f"--resolution {needed} may do" if needed <= MAX_RESOLUTION else "no resolution would do"


def _text(result: dict[str, Any]) -> str:
    closed = "watertight" if result["watertight"] else "not watertight"
    faces = f"{result['quads']:,} quads" if result["quads"] else f"{result['faces']:,} triangles"
    counts = f"{faces}, {result['vertices']:,} vertices, {closed}, volume {result['volume']:.6g}"
    return f"{', '.join(result['files'])}: {counts}, {result['seconds']:.1f} s"
