"""The bodies being fitted as arrays of free numbers, and their way to a scene.

They live in the frame of the fit: the cloud's diagonal is 1, and a mirror plane, where there is one, is x = 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

# What exponents are fitted between. Below the first a strip is a needle whose cusps no cloud resolves; above the second it
# differs from a plane by less than a hundredth of its half-width even at a corner, and its derivatives carry no more news.
GAMMAS = 0.3, 200.0
FRAMED_GAMMAS = 1.5, 30.0
_LEAST_DUAL = 1.05
HARDNESSES = 1.0, 30.0
# What mirroring in x = 0 does to a point, or a normal.
FLIP = np.array([-1.0, 1.0, 1.0])


@dataclass(frozen=True, eq=False)
class Bodies:
    """K bodies of S strips in all: the terms sign exp(hardness (1 - H)) of eq. 44, level 1, H the sum of |h|^gamma (eq. 13).

    h = normal . x + offset, the half-width being in the normal's length. Strips are sorted by the body they belong to. A
    mirrored body stands for two: its image in x = 0 is one more term of the sum, moved by the same numbers.

    A lone body's last `grouped` strips may be a group, raised together: (sum |h|^g)^(G/g) (eqs. 7, 14). Then `gamma` has one
    exponent for each strip before them, then G, then g.

    The first three strips of *framed* bodies stay at right angles and below the half-widths `widest`: so no body of a composite
    can grow through the others into a place where no point tells of it.
    """

    normal: Array  # (S, 3)
    offset: Array  # (S,)
    gamma: Array  # (S,), of a body with a group (S - grouped + 2,)
    owner: Indices  # (S,) the body of each strip
    hardness: Array  # (K,)
    sign: Array  # (K,) 1.0 adds, -1.0 carves
    mirrored: NDArray[np.bool_]  # (K,)
    widest: Array | None = None  # (K, 3) the largest half-widths of framed bodies
    grouped: int = 0

    @classmethod
    def lone(cls, normal: Array, offset: Array, gamma: Array, hardness: float = 1.0, sign: float = 1.0) -> Bodies:
        """One body of strips: normals (S, 3), offsets (S,), exponents (S,)."""
        owner = np.zeros(len(normal), dtype=np.intp)
        return cls(normal, offset, gamma, owner, np.array([hardness]), np.array([sign]), np.zeros(1, dtype=bool))

    def __len__(self) -> int:
        return len(self.sign)

    @property
    def framed(self) -> bool:
        """Whether the bodies are."""
        return self.widest is not None

    @property
    def gammas(self) -> tuple[float, float]:
        """What exponents are fitted between; bodies that can grow no wider are held to rounder ones."""
        return FRAMED_GAMMAS if self.widest is not None and np.isfinite(self.widest).all() else GAMMAS

    @property
    def own_gamma(self) -> Array:
        """(S,) the exponent of each strip, a group's inner one where it is in a group."""
        return np.concatenate([self.gamma[: len(self.owner) - self.grouped], np.repeat(self.gamma[-1], self.grouped)])

    @cached_property
    def start(self) -> Indices:
        """(K,) each body's first strip."""
        return np.searchsorted(self.owner, np.arange(len(self))).astype(np.intp)

    @cached_property
    def summed(self) -> Array:
        """(K, S) what sums the strips of each body: ones at its own."""
        return (self.owner == np.arange(len(self))[:, None]).astype(float)

    @property
    def size(self) -> int:
        """How many numbers are free: those of `moved`."""
        count, bodies = len(self.owner), len(self)
        return 4 * count + len(self.gamma) + (bodies if bodies > 1 else 0) - (3 * bodies if self.framed else 0)

    def moved(self, step: Array) -> Bodies:
        """The bodies after a step of all free numbers: normals, offsets, ln gamma, and of several bodies ln hardness.

        Of framed bodies the middle, the turn and ln of the three half-widths come first, then what further strips have.
        """
        if self.framed:
            return self._frames_moved(step)
        count = len(self.owner)
        normal, offset, gamma, hardness = np.split(step, [3 * count, 4 * count, 4 * count + len(self.gamma)])
        moved = replace(self, normal=self.normal + normal.reshape(-1, 3), offset=self.offset + offset)
        return moved._pressed(gamma, hardness)

    def numbers(self, chosen: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """(size,) which numbers of a step move these (K,) of framed bodies."""
        strips = chosen[self.owner]
        further = strips[self._frames()[1]]
        hardness = chosen if len(self) > 1 else chosen[:0]
        return np.concatenate([np.repeat(chosen, 9), np.repeat(further, 3), further, strips, hardness])

    def held(self, step: Array) -> NDArray[np.bool_]:
        """(size,) which numbers of a step would only lead out of their range."""
        count, bodies = len(self.gamma), len(self)
        held = np.zeros(self.size, dtype=bool)
        behind = bodies if bodies > 1 else 0
        gamma, hardness = np.split(np.arange(self.size - count - behind, self.size), [count])
        for numbers, value, (low, high) in (
            (gamma, self.gamma, self.gammas),
            (hardness, self.hardness[:behind], HARDNESSES),
        ):
            held[numbers] = (value <= low) & (step[numbers] < 0) | (value >= high) & (step[numbers] > 0)
        if self.widest is not None:
            width = 9 * np.arange(bodies)[:, None] + np.arange(6, 9)
            first, _ = self._frames()
            wide = np.linalg.norm(self.normal[first], axis=2) * self.widest <= 1 + 1e-9
            held[width] = wide & (step[width] > 0)
        return held

    def reduced(self, rows: Array) -> Array:
        """Derivatives by the numbers that `moved` takes, (size, N), of those by normals, offsets, ln gamma (and ln hardness)."""
        if not self.framed:
            return rows
        count = len(self.owner)
        by_normal, by_offset, rest = np.split(rows, [3 * count, 4 * count])
        by_normal = by_normal.reshape(count, 3, -1)
        first, further = self._frames()
        m, middle = self.normal[first], self.middles
        turned = np.cross(np.eye(3), m[:, :, None]).swapaxes(1, 2)  # (K, 3 turns, 3 strips, 3)
        by_turn = turned.reshape(-1, 3, 9) @ by_normal[first].reshape(len(self), 9, -1)
        by_turn -= np.einsum("ktaj,kj->kta", turned, middle) @ by_offset[first]
        by_middle = -m.swapaxes(1, 2) @ by_offset[first]
        by_width = -(m[:, :, None] @ by_normal[first])[:, :, 0] - self.offset[first][..., None] * by_offset[first]
        frames = np.concatenate([by_middle, by_turn, by_width], axis=1).reshape(9 * len(self), -1)
        return np.concatenate([frames, by_normal[further].reshape(3 * len(further), rows.shape[1]), by_offset[further], rest])

    @cached_property
    def middles(self) -> Array:
        """(K, 3) where the first three strips of each body have their middles."""
        first, _ = self._frames()
        return np.asarray(np.linalg.solve(self.normal[first], -self.offset[first][..., None])[..., 0])

    def _frames(self) -> tuple[Indices, Indices]:
        """The first three strips of each body, (K, 3), and all further ones, (E,)."""
        first = self.start[:, None] + np.arange(3)
        return first, np.setdiff1d(np.arange(len(self.owner)), first)

    def _frames_moved(self, step: Array) -> Bodies:
        first, further = self._frames()
        frames, normal, offset, gamma, hardness = np.split(
            step, np.cumsum([9 * len(self), 3 * len(further), len(further), len(self.gamma)])
        )
        shift, turn, width = np.split(frames.reshape(-1, 9), 3, axis=1)
        rotation = Rotation.from_rotvec(np.clip(turn, -0.5, 0.5)).as_matrix()
        turned = np.einsum("kij,kaj->kai", rotation, self.normal[first]) / np.exp(np.clip(width, -0.5, 0.5))[..., None]
        turned *= np.maximum(1.0, 1.0 / (np.linalg.norm(turned, axis=2) * self.widest))[..., None]
        normals, offsets = self.normal.copy(), self.offset.copy()
        normals[first], offsets[first] = turned, -np.einsum("kai,ki->ka", turned, self.middles + shift)
        normals[further] += normal.reshape(-1, 3)
        offsets[further] += offset
        return replace(self, normal=normals, offset=offsets)._pressed(gamma, hardness)

    def _pressed(self, gamma: Array, hardness: Array) -> Bodies:
        """With other exponents and, of several bodies, hardnesses."""
        exponent = np.clip(self.gamma * np.exp(np.clip(gamma, -1.0, 1.0)), *self.gammas)
        if len(self) == 1:
            return replace(self, gamma=exponent)
        return replace(self, gamma=exponent, hardness=np.clip(self.hardness * np.exp(np.clip(hardness, -1.0, 1.0)), *HARDNESSES))

    def images(self) -> Bodies:
        """The same with every mirror image a body of its own, after the others."""
        if not self.mirrored.any():
            return self
        twice = self.mirrored[self.owner]
        number = np.cumsum(self.mirrored) - 1 + len(self)
        return Bodies(
            np.concatenate([self.normal, self.normal[twice] * FLIP]),
            np.concatenate([self.offset, self.offset[twice]]),
            np.concatenate([self.gamma, self.gamma[twice]]),
            np.concatenate([self.owner, number[self.owner[twice]]]).astype(np.intp),
            np.concatenate([self.hardness, self.hardness[self.mirrored]]),
            np.concatenate([self.sign, self.sign[self.mirrored]]),
            np.zeros(len(self) + int(self.mirrored.sum()), dtype=bool),
        )

    def only(self, body: int) -> Bodies:
        """One of the bodies alone."""
        own = self.owner == body
        here = slice(body, body + 1)
        owner = np.zeros(int(own.sum()), dtype=np.intp)
        normal, offset, gamma = self.normal[own], self.offset[own], self.gamma[own]
        widest = None if self.widest is None else self.widest[here]
        return Bodies(normal, offset, gamma, owner, self.hardness[here], self.sign[here], self.mirrored[here], widest)

    def others(self, body: int) -> list[Bodies]:
        """All the other bodies, each alone."""
        return [self.only(k) for k in range(len(self)) if k != body]

    def without_strip(self, strip: int) -> Bodies:
        """One strip less."""
        return replace(
            self,
            normal=np.delete(self.normal, strip, axis=0),
            offset=np.delete(self.offset, strip),
            gamma=np.delete(self.gamma, strip),
            owner=np.delete(self.owner, strip),
        )

    def with_strip(self, body: int, normal: Array, offset: float, gamma: float) -> Bodies:
        """One strip more at the end of a body's, before its group."""
        at = int(np.searchsorted(self.owner, body, side="right")) - self.grouped
        return replace(
            self,
            normal=np.insert(self.normal, at, normal, axis=0),
            offset=np.insert(self.offset, at, offset),
            gamma=np.insert(self.gamma, at, gamma),
            owner=np.insert(self.owner, at, body),
        )

    def with_group(self, chosen: NDArray[np.bool_]) -> Bodies:
        """A lone body, so far without a group, with these (S,) of its strips for one; the same where their exponents agree."""
        order = np.argsort(chosen, kind="stable")
        shared = np.exp(np.mean(np.log(self.gamma[chosen])))
        gamma = np.concatenate([self.gamma[~chosen], [shared, shared]])
        return replace(self, normal=self.normal[order], offset=self.offset[order], gamma=gamma, grouped=int(chosen.sum()))

    def without_group(self) -> Bodies:
        """A body with a group with its strips apart, their exponents the group's."""
        gamma = np.concatenate([self.gamma[:-2], np.full(self.grouped, self.gamma[-2])])
        return replace(self, gamma=gamma, grouped=0)

    def squared(self) -> Bodies:
        """A lone body with its first three strips put at right angles, and framed, of any width."""
        length = np.linalg.norm(self.normal[:3], axis=1, keepdims=True)
        u, _, v = np.linalg.svd(self.normal[:3] / length)
        normal, offset = self.normal.copy(), self.offset.copy()
        normal[:3] = u @ v * length
        middle = np.linalg.solve(self.normal[:3], -self.offset[:3])
        offset[:3] = -normal[:3] @ middle
        return replace(self, normal=normal, offset=offset, widest=np.full((1, 3), np.inf))

    def dual(self) -> Bodies:
        """A body with a group of two turned to its diagonals, its inner exponent g / (g - 1): for g = 1, 2 and inf the same."""
        inner = max(self.gamma[-1], _LEAST_DUAL)
        turn = np.array([(1.0, 1.0), (1.0, -1.0)]) / 2 ** (1 - 1 / inner)
        normal = np.concatenate([self.normal[:-2], turn @ self.normal[-2:]])
        offset = np.concatenate([self.offset[:-2], turn @ self.offset[-2:]])
        gamma = np.append(self.gamma[:-1], inner / (inner - 1))
        return replace(self, normal=normal, offset=offset, gamma=gamma)


def joined(parts: Sequence[Bodies]) -> Bodies:
    """All of some framed bodies in one."""
    before = np.cumsum([0, *[len(part) for part in parts]])
    owner = np.concatenate([part.owner + first for part, first in zip(parts, before, strict=False)])
    columns = ("normal", "offset", "gamma", "hardness", "sign", "mirrored", "widest")
    normal, offset, gamma, hardness, sign, mirrored, widest = (
        np.concatenate([getattr(part, name) for part in parts]) for name in columns
    )
    return Bodies(normal, offset, gamma, owner, hardness, sign, mirrored, widest)
