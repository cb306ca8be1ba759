"""The world's grid over the picture: what a drag with Ctrl snaps to."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..session import Session
from ..tools.aim import Aim, Array
from ..tools.arranging import Move
from ..tools.sculpting import Push
from .overlay import Color, Pen

# Lines to either side of the middle, the parts that each is drawn in, and every which one stands out.
_LINES, _PARTS, _STRONG = 30, 4, 10
_FAINT, _PLAIN = (1.0, 1.0, 1.0, 0.10), (1.0, 1.0, 1.0, 0.24)
# The cosine from which on an axis counts as looked along: the grid lies across it then, and on the ground else.
_ALONG = 0.97


def shown(session: Session) -> bool:
    """Whether it is wanted, or something snaps to it just now."""
    held = session.held
    return session.preferences.grid or (held is not None and held.snap and isinstance(held.gesture, (Move, Push)))


def draw(session: Session, aim: Aim, pen: Pen) -> None:
    """Lines at multiples of the step, around what the camera looks at."""
    if not shown(session):
        return
    back = np.abs(aim.camera.axes()[2])
    across = int(np.argmax(back)) if np.max(back) > _ALONG else 2
    for axis in {0, 1, 2} - {across}:
        other = 3 - across - axis
        middle = round(aim.camera.target[axis] / aim.step)
        for number in range(middle - _LINES, middle + _LINES + 1):
            line = _line(aim, axis, number * aim.step, other)
            for ends in pairwise(aim.pixel(line)):
                pen.line(np.array(ends), _color(number), 1.0)


def _line(aim: Aim, axis: int, at: float, along: int) -> Array:
    """Points (n, 3) of the line where this axis is `at`, along another axis, in the plane of the two through the origin."""
    middle = round(aim.camera.target[along] / aim.step)
    line = np.zeros((_PARTS + 1, 3))
    line[:, axis] = at
    line[:, along] = aim.step * np.linspace(middle - _LINES, middle + _LINES, _PARTS + 1)
    return line


def _color(number: int) -> Color:
    return _FAINT if number % _STRONG else _PLAIN
