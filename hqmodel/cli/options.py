"""The arguments and options that mean the same in every command, and the scene that they lead to."""

from __future__ import annotations

import json
import re
from math import isfinite
from typing import TYPE_CHECKING, Annotated, Any

import typer

from hqmodel.edit import EditError, put
from hqmodel.files import load
from hqmodel.model import Scene, shown

from .faults import USAGE, Fault

if TYPE_CHECKING:
    from hqmodel.field import Plane

Preset = Annotated[str, typer.Argument(metavar="PRESET", help="A preset file, or the name of a built-in preset.")]
Slice = Annotated[float | None, typer.Option("--slice", metavar="T", help="The slice t, instead of the preset's.")]
Set = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="PATH=VALUE",
        help="Another value for a field, as gamma=8 or shapes[0].strips[1].gamma=8; may be repeated.",
    ),
]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object on stdout and nothing else.")]
Quiet = Annotated[bool, typer.Option("-q", "--quiet", help="Print nothing but errors.")]

# A decimal number as people and spreadsheets write it.
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)
PLANE_HELP = "x=D, y=D or z=D, or A,B,C=D for Ax + By + Cz = D."
_AXES = {"x": "1,0,0", "y": "0,1,0", "z": "0,0,1"}


def scene_of(preset: str, slice_t: float | None, settings: list[str] | None) -> Scene:
    """The preset's scene as the options want it.

    Raises PresetError, and Fault when the options are at fault.
    """
    return adjusted(load(preset), slice_t, settings)


def adjusted(scene: Scene, slice_t: float | None, settings: list[str] | None) -> Scene:
    """The scene with --slice and then each --set applied, in order; Fault when they are at fault."""
    if slice_t is not None:
        scene = _put(scene, "--slice", "slice", slice_t)
    for setting in settings or ():
        path, equals, text = setting.partition("=")
        if not equals or not path.strip():
            raise Fault(f"--set: expected PATH=VALUE, got {shown(setting)}", USAGE)
        scene = _put(scene, "--set", path.strip(), _value(text))
    return scene


def _put(scene: Scene, option: str, path: str, value: Any) -> Scene:
    try:
        return put(scene, path, value)
    except EditError as error:
        raise Fault(f"{option}: {error}", USAGE) from None


def _value(text: str) -> Any:
    """A value as JSON has it, or a number as people also write it (.5, +2, 3.); what is neither is meant as text."""
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        text = text.strip()
        return float(text) if NUMBER.fullmatch(text) else text


def plane_of(option: str, text: str) -> Plane:
    """The plane that an option asks for; that of an axis is seen from the right, the front or the top."""
    from hqmodel.field import Plane  # late: it brings SciPy with it

    left, equals, right = (part.strip() for part in text.partition("="))
    numbers = [part.strip() for part in _AXES.get(left, left).split(",")]
    if equals and len(numbers) == 3 and all(map(NUMBER.fullmatch, [*numbers, right])):
        sign = -1.0 if left == "y" else 1.0  # seen from the front
        x, y, z, offset = (sign * float(number) for number in (*numbers, right))
        if all(map(isfinite, (x, y, z, offset))) and (x or y or z):
            return Plane((x, y, z), offset)
    raise Fault(f"{option}: expected a plane such as z=0.2 or 1,0,-1=0.5, got {shown(text)}", USAGE)
