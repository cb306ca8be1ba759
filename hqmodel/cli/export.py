"""hqmodel export: the body as a triangle mesh."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import Annotated, Any, Literal

import typer

from .faults import INPUT, USAGE, Fault
from .options import Json, Preset, Quiet, Set, Slice, scene_of
from .outputs import checked, tell, writing
from .progress import progress

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
    int,
    typer.Option("--resolution", metavar="N", min=4, max=2048, help="Cells along the longest side; radial: quads round it."),
]
Method_ = Annotated[
    Method, typer.Option("--method", help="Marching cubes, or a radial grid: quads with texture coordinates, in .obj.")
]
TargetFaces = Annotated[
    int | None, typer.Option("--target-faces", metavar="N", min=4, help="Reduce the mesh to at most so many triangles.")
]
Unit_ = Annotated[Unit | None, typer.Option("--unit", help="The unit that lengths in the file are in.")]
Size = Annotated[float | None, typer.Option("--size", metavar="X", help="The longest side, in that unit.")]
Up_ = Annotated[Up | None, typer.Option("--up", help="The axis that points up; by default what the format's users expect.")]
Colors = Annotated[bool, typer.Option("--colors/--no-colors", help="Vertex colours, where the format has them.")]
Normals = Annotated[bool, typer.Option("--normals/--no-normals", help="Vertex normals, where the format has them.")]


def export(
    preset: Preset,
    output: Output,
    resolution: Resolution = 256,
    method: Method_ = "cubes",
    target_faces: TargetFaces = None,
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
    if method == "radial" and target_faces is not None:
        raise Fault("--target-faces: expected --method cubes with it, got radial", USAGE)
    checked(output, mesh.FORMATS, [preset])
    try:
        if method == "cubes":
            mesh.must_have_room(scene, resolution, target_faces is not None)
        with progress(quiet) as report:
            made = (
                mesh.radial_quads(scene, resolution, report)
                if method == "radial"
                else mesh.polygonize(scene, resolution, report, target_faces=target_faces)
            )
            body = mesh.sized(made, size)
        result = mesh.report(body)
        shaded = replace(body, colors=body.colors if colors else None, normals=body.normals if normals else None)
        with writing(output) as streams:
            for path, stream in zip(output, streams, strict=True):
                suffix = path.suffix.lower()
                mesh.write(mesh.fitted(shaded, suffix, unit=unit, up=up), stream, suffix, scene.name)
    except mesh.MeshError as error:
        raise Fault(f"{preset}: {error}", INPUT) from None
    result |= {"method": method, "quads": len(body.quads.corners) if body.quads else 0}
    result |= {"resolution": resolution, "seconds": perf_counter() - started, "files": [str(path) for path in output]}
    tell(result, _text(result), as_json, quiet)


def _text(result: dict[str, Any]) -> str:
    closed = "watertight" if result["watertight"] else "not watertight"
    faces = f"{result['quads']:,} quads" if result["quads"] else f"{result['faces']:,} triangles"
    counts = f"{faces}, {result['vertices']:,} vertices, {closed}, volume {result['volume']:.6g}"
    return f"{', '.join(result['files'])}: {counts}, {result['seconds']:.1f} s"
