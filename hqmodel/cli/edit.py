"""hqmodel edit: the modeller's window."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from hqmodel.edit import new_scene
from hqmodel.files import find, load
from hqmodel.model import Scene

from .faults import MACHINE, Fault
from .options import Set, Slice, adjusted

Optional = Annotated[str | None, typer.Argument(metavar="[PRESET]", help="A preset file, or the name of a built-in preset.")]


def edit(preset: Optional = None, slice_t: Slice = None, settings: Set = None) -> None:
    """Open the modeller, as hqmodel without a command does.

    What --slice and --set change is the first step that undo takes back.
    """
    scene = load(preset) if preset is not None else new_scene()
    changes = adjusted(scene, slice_t, settings) != scene
    path = find(preset) if preset is not None else None
    window(path, (lambda opened: adjusted(opened, slice_t, settings)) if changes else None)


def window(path: Path | None, change: Callable[[Scene], Scene] | None = None) -> None:
    """Open the modeller's window; Fault where there is no display."""
    from hqmodel import app  # late: a preset at fault is told before any window opens

    try:
        app.run(path, change)
    except app.NoDisplay as error:
        raise Fault(str(error), MACHINE) from None
