"""The mirror planes that a field has exactly, to the last bit."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np

from .region import Region
from .terms import Array, Terms


def mirror_axes(terms: Terms, region: Region) -> tuple[int, ...]:
    """The axes (0, 1, 2) along which reflecting the world through the origin changes nothing: not F, not the cut.

    Decided by comparing the planes themselves, so a shape with its mirror image qualifies, and so does any shape whose own
    strips map onto each other; a field that is symmetric only up to rounding does not.
    """
    plain = _signature(terms, np.ones(3))
    found = []
    for axis in range(3):
        flip = np.ones(3)
        flip[axis] = -1
        if _signature(terms, flip) == plain and (not region.cut or region.low[axis] == -region.high[axis]):
            found.append(axis)
    return tuple(found)


def _signature(terms: Terms, flip: Array) -> Counter[Any]:
    """The terms as a multiset that does not depend on their order, nor on which of two bounding planes comes first."""
    planes = np.column_stack([terms.normal * flip, terms.offset]) + 0.0
    leading = planes[np.arange(len(planes)), np.argmax(planes != 0, axis=1)] if len(planes) else np.empty(0)
    planes = planes * np.where(leading < 0, -1.0, 1.0)[:, None] + 0.0
    strips = [(*plane, gamma) for plane, gamma in zip(planes.tolist(), terms.inner.tolist(), strict=True)]
    groups: list[list[Any]] = [[] for _ in terms.group_start]
    for strip, group in zip(strips, terms.group_of_strip, strict=True):
        groups[group].append(strip)
    parts: list[list[Any]] = [[] for _ in terms.term_start]
    for g, (outer, sign, term) in enumerate(zip(terms.outer, terms.group_sign, terms.term_of_group, strict=True)):
        parts[term].append((float(outer), float(sign), tuple(sorted(groups[g]))))
    numbers = zip(
        terms.coefficient.tolist(), terms.hardness.tolist(), terms.constant.tolist(), terms.term_source.tolist(), strict=True
    )
    return Counter((*own, tuple(sorted(part))) for own, part in zip(numbers, parts, strict=True))
