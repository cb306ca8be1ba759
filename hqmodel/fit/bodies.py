"""The bodies being fitted as arrays of free numbers, and their way to a scene.

They live in the frame of the fit: the cloud's diagonal is 1, and a mirror plane, where there is one, is x = 0.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

# What exponents are fitted between. Below the first a strip is a needle whose cusps no cloud resolves; above the second it
# differs from a plane by less than a hundredth of its half-width even at a corner, and its derivatives carry no more news.
GAMMAS = 0.3, 200.0
HARDNESSES = 0.3, 60.0
_FLIP = np.array([-1.0, 1.0, 1.0])


@dataclass(frozen=True, eq=False)
class Bodies:
    """K bodies of S strips in all: the terms sign exp(hardness (1 - H)) of eq. 44, level 1, H the sum of |h|^gamma (eq. 13).

    h = normal . x + offset, the half-width being in the normal's length. Strips are sorted by the body they belong to. A
    mirrored body stands for two: its image in x = 0 is one more term of the sum, moved by the same numbers.
    """

    normal: Array  # (S, 3)
    offset: Array  # (S,)
    gamma: Array  # (S,)
    owner: Indices  # (S,) the body of each strip
    hardness: Array  # (K,)
    sign: Array  # (K,) 1.0 adds, -1.0 carves
    mirrored: NDArray[np.bool_]  # (K,)

    @classmethod
    def lone(cls, normal: Array, offset: Array, gamma: Array, hardness: float = 1.0, sign: float = 1.0) -> Bodies:
        """One body of strips: normals (S, 3), offsets (S,), exponents (S,)."""
        owner = np.zeros(len(normal), dtype=np.intp)
        return cls(normal, offset, gamma, owner, np.array([hardness]), np.array([sign]), np.zeros(1, dtype=bool))

    def __len__(self) -> int:
        return len(self.sign)

    @cached_property
    def start(self) -> Indices:
        """(K,) each body's first strip."""
        return np.searchsorted(self.owner, np.arange(len(self))).astype(np.intp)

    @property
    def size(self) -> int:
        """How many numbers are free: those of `moved`."""
        return 5 * len(self.owner) + (len(self) if len(self) > 1 else 0)

    def moved(self, step: Array) -> Bodies:
        """The bodies after a step of all free numbers: normals, offsets, ln gamma, and of several bodies ln hardness."""
        count = len(self.owner)
        normal, offset, gamma, hardness = np.split(step, [3 * count, 4 * count, 5 * count])
        return replace(
            self,
            normal=self.normal + normal.reshape(-1, 3),
            offset=self.offset + offset,
            gamma=np.clip(self.gamma * np.exp(np.clip(gamma, -1.0, 1.0)), *GAMMAS),
            hardness=np.clip(self.hardness * np.exp(np.clip(hardness, -1.0, 1.0)), *HARDNESSES)
            if len(self) > 1
            else self.hardness,
        )

    def images(self) -> Bodies:
        """The same with every mirror image a body of its own, after the others."""
        if not self.mirrored.any():
            return self
        twice = self.mirrored[self.owner]
        number = np.cumsum(self.mirrored) - 1 + len(self)
        return Bodies(
            np.concatenate([self.normal, self.normal[twice] * _FLIP]),
            np.concatenate([self.offset, self.offset[twice]]),
            np.concatenate([self.gamma, self.gamma[twice]]),
            np.concatenate([self.owner, number[self.owner[twice]]]).astype(np.intp),
            np.concatenate([self.hardness, self.hardness[self.mirrored]]),
            np.concatenate([self.sign, self.sign[self.mirrored]]),
            np.zeros(len(self) + int(self.mirrored.sum()), dtype=bool),
        )

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
        """One strip more at the end of a body's."""
        at = int(np.searchsorted(self.owner, body, side="right"))
        return replace(
            self,
            normal=np.insert(self.normal, at, normal, axis=0),
            offset=np.insert(self.offset, at, offset),
            gamma=np.insert(self.gamma, at, gamma),
            owner=np.insert(self.owner, at, body),
        )
