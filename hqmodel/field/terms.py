"""A scene flattened to the arrays that the sum of eq. 44 is evaluated from, in world space.

Everything downstream (evaluation, bounds, rays, the GPU's copy) reads these arrays, so a transform, a mirror image or the slice
is worked out once, here.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from hqmodel.model import Scene, Shape

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

# Beyond this a number takes no part in any shape one can see; kept below the square root of the largest float64, so that
# products of two of them stay finite.
HUGE = 1e150


@dataclass(frozen=True, eq=False)
class Terms:
    """The terms of F = sum_k c_k exp(beta_k (C_k - H_k)) - w, with H_k = sum_j sigma_j (sum_a |h_a|^g_a)^(G_j / g_j).

    S strips are sorted by group and G groups by term (a lone strip is a group of its own); a mirrored shape gives one term for
    each image. h_a(x) = normal[a] . x + offset[a] in world coordinates, slice and half-width included.

    `chosen_from` are the terms that these are some of; None where they are all.
    """

    normal: Array  # (S, 3)
    offset: Array  # (S,)
    inner: Array  # (S,) the exponent g of each strip in its group
    group_start: Indices  # (G,) index of each group's first strip
    outer: Array  # (G,) the exponent G of each group
    group_sign: Array  # (G,) sigma, 1.0 or -1.0
    term_start: Indices  # (K,) index of each term's first group
    coefficient: Array  # (K,) c, never 0
    hardness: Array  # (K,) beta
    constant: Array  # (K,) C
    strip_source: Indices  # (S, 2) the shape and the strip in it
    term_source: Indices  # (K,) the shape
    level: float
    chosen_from: Terms | None = None

    @classmethod
    def of(cls, scene: Scene) -> Self:
        """The terms of the scene's visible shapes, at the scene's slice."""
        rows = _Rows()
        for index, shape in enumerate(scene.shapes):
            if shape.visible and shape.coefficient != 0:
                rows.add_shape(index, shape, scene.slice)
        return cls(**rows.arrays(), level=scene.level)

    def __len__(self) -> int:
        return len(self.term_start)

    @cached_property
    def grouped(self) -> bool:
        """Whether any group holds more than one strip or has an exponent of its own."""
        return len(self.group_start) < len(self.inner) or bool(np.any(self.outer != self.inner[self.group_start]))

    @cached_property
    def hyperbolic(self) -> bool:
        """Whether any sign is negative."""
        return bool(np.any(self.group_sign < 0))

    @cached_property
    def group_of_strip(self) -> Indices:
        """(S,) the group each strip belongs to."""
        return np.repeat(np.arange(len(self.group_start)), np.diff(self.group_start, append=len(self.inner)))

    @cached_property
    def term_of_group(self) -> Indices:
        """(G,) the term each group belongs to."""
        return np.repeat(np.arange(len(self)), np.diff(self.term_start, append=len(self.group_start)))

    @cached_property
    def term_of_strip(self) -> Indices:
        """(S,) the term each strip belongs to."""
        return self.term_of_group[self.group_of_strip]

    @cached_property
    def log_coefficient(self) -> Array:
        """(K,) ln |c|."""
        return np.log(np.abs(self.coefficient))

    @cached_property
    def positive(self) -> NDArray[np.bool_]:
        """(K,) whether each term adds."""
        return self.coefficient > 0

    def keep(self, chosen: NDArray[np.bool_]) -> Terms:
        """Only the chosen terms, (K,) booleans; the level stays."""
        if bool(np.all(chosen)):
            return self
        groups = chosen[self.term_of_group]
        strips = groups[self.group_of_strip]
        return replace(
            self,
            normal=self.normal[strips],
            offset=self.offset[strips],
            inner=self.inner[strips],
            group_start=_starts(self.group_of_strip[strips]),
            outer=self.outer[groups],
            group_sign=self.group_sign[groups],
            term_start=_starts(self.term_of_group[groups]),
            coefficient=self.coefficient[chosen],
            hardness=self.hardness[chosen],
            constant=self.constant[chosen],
            strip_source=self.strip_source[strips],
            term_source=self.term_source[chosen],
            chosen_from=self.chosen_from or self,
        )


def _starts(labels: Indices) -> Indices:
    """Where each run of equal labels begins."""
    return np.flatnonzero(np.diff(labels, prepend=-1)).astype(np.intp)


def rotation_matrix(quaternion: tuple[float, float, float, float]) -> Array:
    """The 3 x 3 matrix of a quaternion x, y, z, w, made exactly unit first."""
    x, y, z, w = np.asarray(quaternion) / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def world_planes(shape: Shape, t: float) -> tuple[Array, Array]:
    """The shape's strips as affine functions of the world point: h = normals @ x + offsets, (n, 3) and (n,)."""
    strips = shape.strips
    with np.errstate(over="ignore"):
        own = np.array([strip.normal for strip in strips], dtype=float)
        shift = np.array([strip.slice for strip in strips]) * t + [strip.offset for strip in strips]
        width = np.array([strip.half_width for strip in strips])
        turned = (own / np.array(shape.transform.scale)) @ rotation_matrix(shape.transform.rotation).T
        normals = np.clip(turned / width[:, None], -HUGE, HUGE)
        offsets = np.clip(shift / width, -HUGE, HUGE) - normals @ np.clip(shape.transform.translation, -HUGE, HUGE)
    return normals, np.clip(offsets, -HUGE, HUGE)


def images(shape: Shape) -> Iterator[Array]:
    """The signs (3,) of each of the shape's mirror images, itself first."""
    for signs in product(*[(1.0, -1.0) if axis in shape.mirror else (1.0,) for axis in ("x", "y", "z")]):
        yield np.array(signs)


class _Rows:
    """Collects the rows of `Terms` shape by shape."""

    def __init__(self) -> None:
        self.strips: list[tuple[Array, float, float, tuple[int, int]]] = []
        self.groups: list[tuple[int, float, int]] = []
        self.terms: list[tuple[int, float, float, float, int]] = []

    def add_shape(self, index: int, shape: Shape, t: float) -> None:
        normals, offsets = world_planes(shape, t)
        for signs in images(shape):
            self.terms.append((len(self.groups), shape.coefficient, shape.hardness, shape.constant, index))
            for members, outer, sign in _groups(shape):
                self.groups.append((len(self.strips), outer, sign))
                for member in members:
                    source = (index, member)
                    self.strips.append((normals[member] * signs, offsets[member], shape.strips[member].gamma, source))

    def arrays(self) -> dict[str, Any]:
        normal, offset, inner, source = zip(*self.strips, strict=True) if self.strips else ((), (), (), ())
        group_start, outer, sign = zip(*self.groups, strict=True) if self.groups else ((), (), ())
        term_start, c, beta, constant, shape = zip(*self.terms, strict=True) if self.terms else ((), (), (), (), ())
        return {
            "normal": np.array(normal, dtype=float).reshape(-1, 3),
            "offset": np.array(offset, dtype=float),
            "inner": np.array(inner, dtype=float),
            "group_start": np.array(group_start, dtype=np.intp),
            "outer": np.array(outer, dtype=float),
            "group_sign": np.array(sign, dtype=float),
            "term_start": np.array(term_start, dtype=np.intp),
            "coefficient": np.array(c, dtype=float),
            "hardness": np.clip(np.array(beta, dtype=float), 0.0, HUGE),
            "constant": np.clip(np.array(constant, dtype=float), -HUGE, HUGE),
            "strip_source": np.array(source, dtype=np.intp).reshape(-1, 2),
            "term_source": np.array(shape, dtype=np.intp),
        }


def _groups(shape: Shape) -> Iterator[tuple[list[int], float, int]]:
    """Members, outer exponent and sign of each group; lone strips first, as groups of one."""
    for index, strip in enumerate(shape.strips):
        if strip.group is None:
            yield [index], strip.gamma, strip.sign
    for name, group in shape.groups.items():
        members = [index for index, strip in enumerate(shape.strips) if strip.group == name]
        if members:
            yield members, group.gamma, group.sign
