"""The one table of editable numbers: range, default, label, unit and help of every numeric field of the format.

Sliders, validation, ``--set`` paths, the JSON Schema and the tests' random scenes are all driven by `FIELDS`. A key is the
field's path with its indices left out: ``shapes[].strips[].gamma``; a group's name likewise: ``shapes[].groups{}.gamma``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from typing import Any

from pydantic import Field

MAX_SHAPES = 256
MAX_STRIPS = 1024


@dataclass(frozen=True)
class Number:
    """What is known of one numeric field, or of each component of one vector field.

    `low` and `high` are what the format permits (`low` itself excluded when `above`); `slider` is the part of it that is
    comfortable to drag in, on a logarithmic scale when `logarithmic`. `parts` names the components of a vector.
    """

    label: str
    help: str
    default: float | tuple[float, ...] | None = None
    low: float = -inf
    high: float = inf
    above: bool = False
    slider: tuple[float, float] = (-2.0, 2.0)
    logarithmic: bool = False
    unit: str = ""
    parts: tuple[str, ...] = ()

    def permits(self, value: float) -> bool:
        """Whether the format permits this finite number here."""
        return (self.low < value if self.above else self.low <= value) and value <= self.high

    def expected(self) -> str:
        """The range in words, as error messages give it."""
        if self.low == -inf:
            return "a finite number"
        if self.high == inf:
            return f"a number above {self.low:g}" if self.above else f"a number of at least {self.low:g}"
        return f"a number from {self.low:g} to {self.high:g}"

    def constraints(self) -> dict[str, Any]:
        """The range as pydantic's constraints on one number."""
        limits: dict[str, Any] = {"strict": True, "allow_inf_nan": False}
        if self.low > -inf:
            limits["gt" if self.above else "ge"] = self.low
        if self.high < inf:
            limits["le"] = self.high
        return limits

    def field(self) -> Any:
        """The pydantic field of a single number; required when the table gives no default."""
        return Field(... if self.default is None else self.default, title=self.label, description=self.help, **self.constraints())

    def vector(self) -> Any:
        """The pydantic field of a vector whose components the caller has annotated."""
        return Field(... if self.default is None else self.default, title=self.label, description=self.help)


_EXPONENT: dict[str, Any] = {"low": 0.05, "high": 1000.0, "slider": (0.2, 100.0), "logarithmic": True}
_XYZ = ("x", "y", "z")

FIELDS: dict[str, Number] = {
    "slice": Number(
        "Slice t",
        "Where the three-dimensional slice through the higher-dimensional shape is taken. "
        "Each plane moves with it at its own slice rate; nothing happens while all rates are 0.",
        0.0,
    ),
    "level": Number(
        "Level w",
        "The value at which the blended field has its surface. Lower lets everything swell and flow together.",
        1.0,
        slider=(0.05, 3.0),
    ),
    "bounds[][]": Number("Bounds", "The box that an unbounded body is cut by; its cut faces are closed on export.", parts=_XYZ),
    "shapes[].coefficient": Number(
        "Coefficient c", "How strongly the shape adds to the body. Below 0 it carves away.", 1.0, slider=(-3.0, 3.0)
    ),
    "shapes[].hardness": Number(
        "Hardness",
        "How abruptly the shape blends with the others: soft flows together, hard keeps its outline. "
        "Alone, a shape looks the same at any hardness.",
        1.0,
        low=0.0,
        above=True,
        slider=(0.2, 40.0),
        logarithmic=True,
    ),
    "shapes[].constant": Number(
        "Constant C", "The value of H on the surface: 1 for closed shapes; 1, 0 or -1 for hyperbolic ones.", 1.0
    ),
    "shapes[].color[]": Number(
        "Colour", "The shape's colour, sRGB.", (0.78, 0.55, 0.42), low=0.0, high=1.0, slider=(0.0, 1.0), parts=("r", "g", "b")
    ),
    "shapes[].transform.translation[]": Number("Position", "Where the shape's own origin lies.", (0.0, 0.0, 0.0), parts=_XYZ),
    "shapes[].transform.rotation[]": Number(
        "Rotation",
        "The shape's turn as a unit quaternion x, y, z, w.",
        (0.0, 0.0, 0.0, 1.0),
        slider=(-1.0, 1.0),
        parts=("x", "y", "z", "w"),
    ),
    "shapes[].transform.scale[]": Number(
        "Scale",
        "The shape's size along its own axes.",
        (1.0, 1.0, 1.0),
        low=0.0,
        above=True,
        slider=(0.1, 10.0),
        logarithmic=True,
        parts=_XYZ,
    ),
    "shapes[].groups{}.gamma": Number("Outer exponent", "How hard the group as a whole is pressed flat.", **_EXPONENT),
    "shapes[].strips[].normal[]": Number(
        "Normal",
        "The direction across the strip, in the shape's own axes. Its length counts: a longer one makes a thinner strip.",
        slider=(-1.0, 1.0),
        parts=_XYZ,
    ),
    "shapes[].strips[].slice": Number("Slice rate", "How fast the strip moves as the slice t slides.", 0.0),
    "shapes[].strips[].offset": Number("Offset", "Shifts the strip along its normal.", 0.0),
    "shapes[].strips[].half_width": Number(
        "Half-width",
        "The distance from the strip's middle to either bounding plane.",
        1.0,
        low=0.0,
        above=True,
        slider=(0.02, 5.0),
        logarithmic=True,
    ),
    "shapes[].strips[].gamma": Number(
        "Exponent",
        "How flat the surface is pulled against the bounding planes: 2 is round, 40 nearly flat, below 1 pinched into cusps.",
        2.0,
        **_EXPONENT,
    ),
}


def place(location: Sequence[str | int]) -> str:
    """A location in a preset as people read it: ``('shapes', 0, 'color', 1)`` is ``shapes[0].color[1]``.

    A key that is not a plain word is quoted, cut to 40 characters and kept on one line.
    """
    text = ""
    for step in location:
        if isinstance(step, int):
            text += f"[{step}]"
        elif re.fullmatch(r"\w{1,40}", step):
            text += f".{step}" if text else step
        else:
            text += f"[{shown(step, 40)}]"
    return text


def pattern(location: Sequence[str | int]) -> str:
    """The `FIELDS` key that a location belongs to, whether or not the table has it."""
    steps = list(location)
    if len(steps) >= 4 and steps[0] == "shapes" and steps[2] == "groups":
        return ".".join(["shapes[].groups{}", *map(str, steps[4:])])
    text = ""
    for step in steps:
        text += "[]" if isinstance(step, int) else f".{step}" if text else step
    return text


def shown(value: object, limit: int = 60) -> str:
    """A value as an error message shows it: one short line, whatever it is."""
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, (list, tuple)) and len(value) > 4:
        return f"a list of {len(value)}"
    if isinstance(value, bool) or value is None:
        return {True: "true", False: "false", None: "null"}[value]
    text = repr(list(value) if isinstance(value, tuple) else value)
    return text if len(text) <= limit else text[: limit - 3] + "..."
