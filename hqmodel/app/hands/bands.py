"""The strips of a flat scene as shaded bands between their bounding lines (Hanson 1988, figure 5)."""

from __future__ import annotations

import numpy as np

from hqmodel.field import Terms, bounding_lines

from ..session import Session
from ..tools.aim import Aim
from .overlay import Pen

# How far bands reach, in sizes of the body; between the lines, and the lines.
_REACH = 1.5
_SHADE, _LINE = (0.27, 0.41, 0.60, 0.16), (0.16, 0.29, 0.47, 0.9)


def draw(session: Session, aim: Aim, pen: Pen) -> None:
    """Over the picture; nothing unless it is wanted and the scene is flat."""
    scene = session.shown
    if not session.view.bands or scene.dimension == 3:
        return
    terms, where = Terms.of(scene), session.shown_region
    middle, far = where.centre[:2], _REACH * float(np.max(where.size[:2]))
    for normal, offset in zip(terms.normal, terms.offset, strict=True):
        lines = bounding_lines(normal[:2], float(offset), middle, far)
        below, above = aim.pixel(np.concatenate([lines, np.zeros((2, 2, 1))], axis=-1))
        pen.area(np.concatenate([below, above[::-1]]), _SHADE)
        for line in (below, above):
            pen.line(line, _LINE)
