"""hqmodel check: whether presets are valid, and what is wrong with them."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from hqmodel.files import PresetError, load

from .faults import DONE, INPUT
from .options import Json, Quiet
from .outputs import tell

Presets = Annotated[list[str], typer.Argument(metavar="PRESET...", help="Preset files, or names of built-in presets.")]


def check(presets: Presets, as_json: Json = False, quiet: Quiet = False) -> None:
    """Validate presets.

    A line on stderr for each problem, and exit status 1 if there is any.
    """
    reports = []
    for preset in presets:
        problems = _problems(preset)
        reports.append({"file": preset, "ok": not problems, "problems": problems})
        for problem in problems:
            print(f"{preset}: {problem}", file=sys.stderr)
    good = all(report["ok"] for report in reports)
    text = "\n".join(f"{report['file']}: ok" for report in reports if report["ok"])
    tell({"ok": good, "files": reports}, text, as_json, quiet)
    raise typer.Exit(DONE if good else INPUT)


def _problems(preset: str) -> list[str]:
    try:
        load(preset)
    except PresetError as error:
        return error.problems
    return []
