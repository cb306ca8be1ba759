"""hqmodel edit: the modeller's window."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from hqmodel.files import find, load

from .faults import MACHINE, Fault

Optional = Annotated[str | None, typer.Argument(metavar="[PRESET]", help="A preset file, or the name of a built-in preset.")]

HEADLESS = "hqmodel export, render, sample, raycast, check and presets work without one"


def edit(preset: Optional = None) -> None:
    """Open the modeller, as hqmodel without a command does."""
    path = _readable(preset) if preset is not None else None
    from hqmodel import app  # late: OpenGL and the window come with it

    try:
        app.run(path)
    except app.NoDisplay as error:
        raise Fault(f"{error}; {HEADLESS}", MACHINE) from None


def _readable(preset: str) -> Path:
    """The preset's file; PresetError before any window opens when it can't be read."""
    load(preset)
    return find(preset)
