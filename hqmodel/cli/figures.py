"""hqmodel figures: the paper's figures as pictures, and a page that explains them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Annotated

import typer

from hqmodel.files import Builtin, builtin, load
from hqmodel.model import shown

from .faults import MACHINE, USAGE, Fault
from .options import Json, Quiet
from .outputs import filling, tell
from .progress import Report, progress

_COLLECTION = "figures"
# The figure that shows how strips bound a shape.
_BANDS = "fig05-"
_PAGE, _PRESETS = "index.html", "presets"

Output = Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="The folder for the pictures and the page.")]
Only = Annotated[
    list[str] | None, typer.Option("--only", metavar="FIGURE", help="A figure's number, or a part of its name; may be repeated.")
]
Size = Annotated[int, typer.Option("--size", metavar="PIXELS", min=32, max=2048, help="How high each stage is.")]


def figures(output: Output, only: Only = None, size: Size = 320, as_json: Json = False, quiet: Quiet = False) -> None:
    """Draw the figures of Hanson's paper.

    Each is one picture of its stages side by side; a page shows them all, explains each and links its preset.
    """
    started = perf_counter()
    chosen = _chosen(only)
    if (output.exists() and not output.is_dir()) or not output.absolute().parent.is_dir():
        raise Fault(f"{output}: expected a folder, or the name of a new one in a folder that exists", USAGE)
    from hqmodel import gpu  # late: a slip on the command line is told at once

    try:
        with filling(output) as folder, progress(quiet) as report:
            pictures = _filled(folder, chosen, size, report)
    except gpu.GpuError as error:
        raise Fault(str(error), MACHINE) from None
    seconds = perf_counter() - started
    files = [str(output / name) for name in [*pictures, _PAGE]]
    tell({"files": files, "seconds": seconds}, f"{output / _PAGE}: {len(chosen)} figures, {seconds:.1f} s", as_json, quiet)


def _filled(folder: Path, chosen: Sequence[Builtin], size: int, report: Report) -> list[str]:
    """Put the pictures, their presets and the page into a folder; the pictures' names. Raises GpuError."""
    from hqmodel import gpu

    from . import plates

    ctx = gpu.offscreen()
    pictures = [f"{preset.name}.png" for preset in chosen]
    (folder / _PRESETS).mkdir()
    sizes = []
    for number, (preset, name) in enumerate(zip(chosen, pictures, strict=True)):
        rows = plates.panels(load(preset.path), ctx, bands=preset.name.startswith(_BANDS))
        drawn = plates.sheet(preset.title, rows, size, partial(_tell, report, number, len(chosen), preset.title))
        drawn.save(folder / name, optimize=True)
        sizes.append(drawn.size)
        (folder / _PRESETS / preset.path.name).write_bytes(preset.path.read_bytes())
    text = plates.page(list(zip(chosen, pictures, sizes, strict=True)), _PRESETS)
    (folder / _PAGE).write_text(text, encoding="utf-8")
    ctx.release()
    return pictures


def _tell(report: Report, number: int, total: int, title: str, share: float) -> None:
    report((number + share) / total, title.partition(":")[0])


def _chosen(only: list[str] | None) -> list[Builtin]:
    """The figures that are meant, in the paper's order."""
    every = [preset for preset in builtin() if preset.collection == _COLLECTION]
    if not only:
        return every
    wanted = []
    for text in only:
        name = f"fig{int(text):02d}-" if re.fullmatch(r"\d{1,2}", text, re.ASCII) else text.casefold()
        found = [preset for preset in every if name in preset.name]
        if not found:
            raise Fault(f"--only: expected a figure from 1 to 19 or a part of a figure's name, got {shown(text)}", USAGE)
        wanted += found
    return [preset for preset in every if preset in wanted]
