"""The triangles within one cell of marching cubes (Lorensen & Cline 1987), worked out instead of copied from a table.

On each face of the cell, runs of inside corners are cut off by segments between the face's crossed edges; the segments of all
six join to loops, which are filled. A face that is inside at two opposite corners only can be cut in two ways: whether its
inside corners are joined is told by the field (the asymptotic decider of Nielson & Hamann 1991, Visualization '91). Both cells at
a face cut it alike, so the surface has no holes.
"""

from __future__ import annotations

from functools import cache
from itertools import product

import numpy as np
from numpy.typing import NDArray

# Corner number 4 x + 2 y + z; edges as their lower corner and axis.
CORNERS = np.array(list(product((0, 1), repeat=3)))
EDGES = [(corner, axis) for axis in range(3) for corner in range(8) if not CORNERS[corner][axis]]
_EDGE_OF = {frozenset((corner, corner + (4 >> axis))): number for number, (corner, axis) in enumerate(EDGES)}


def _faces() -> list[tuple[int, int, int, int]]:
    """The corners of each face in counter-clockwise order seen from outside, faces in the order of axis, then side."""
    faces = []
    for axis, side in product(range(3), (0, 1)):
        step, right, up = (4 >> (axis + i) % 3 for i in range(3))
        corner = side * step
        ring = corner, corner + right, corner + right + up, corner + up
        faces.append(ring if side else (ring[0], ring[3], ring[2], ring[1]))
    return faces


FACES = _faces()
# For each case the faces, as bits, that are inside at two opposite corners only.
AMBIGUOUS = np.array(
    [
        sum(
            1 << face
            for face, ring in enumerate(FACES)
            if [case >> corner & 1 for corner in ring] in ([1, 0, 1, 0], [0, 1, 0, 1])
        )
        for case in range(256)
    ],
    dtype=np.uint8,
)


@cache
def triangles(case: int, joined: int) -> NDArray[np.int8]:
    """Edges (n,), three to a triangle, outward, of the cell whose corners inside are the bits of `case`.

    The inside corners of ambiguous faces are joined where `joined` has the face's bit.
    """
    following: dict[int, int] = {}
    for face, ring in enumerate(FACES):
        inside = [bool(case >> corner & 1) for corner in ring]
        edges = [_EDGE_OF[frozenset((ring[i], ring[(i + 1) % 4]))] for i in range(4)]
        leaving = [i for i in range(4) if inside[i] and not inside[(i + 1) % 4]]
        for i in leaving:
            # back to where this run of inside corners began or, with runs joined, on to where the next begins
            step = -1 if not (AMBIGUOUS[case] & joined) >> face & 1 else 1
            j = (i + step) % 4
            while inside[j] or not inside[(j + 1) % 4]:
                j = (j + step) % 4
            following[edges[i]] = edges[j]
    result: list[int] = []
    while following:
        loop = [next(iter(following))]
        while (edge := following.pop(loop[-1])) != loop[0]:
            loop.append(edge)
        result += _filled(loop)
    return np.array(result, dtype=np.int8)


def _filled(loop: list[int]) -> list[int]:
    """A fan over a loop of edges, from the one with the fewest diagonals within a face of the cell, where they might double."""
    turns = [loop[i:] + loop[:i] for i in range(len(loop))]
    fan = min(turns, key=lambda turn: sum(_on_one_face(turn[0], other) for other in turn[2:-1]))
    return [edge for i in range(1, len(fan) - 1) for edge in (fan[0], fan[i + 1], fan[i])]


def _on_one_face(one: int, other: int) -> bool:
    corners = {corner + step for corner, axis in (EDGES[one], EDGES[other]) for step in (0, 4 >> axis)}
    return any(corners <= set(ring) for ring in FACES)
