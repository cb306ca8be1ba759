"""The nodes of some blocks of the grid, each once, and the field there."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .cubes import CORNERS
from .cull import Blocks
from .grid import ALONG, BLOCK
from .mesh import Array
from .sampling import Indices, Numbers, Samples, Sampling
from .sheets import moves


def _lattice(count: int) -> Numbers:
    steps = np.arange(count)
    return np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)


# A block has nodes of its own, all but those on its far sides, which are its neighbours'.
OWN = _lattice(BLOCK)
ALL = _lattice(BLOCK + 1)
# Of all nodes of a block: the corner of it whose block they belong to, and which of that one's own they are.
_CORNER = ALL // BLOCK @ np.array([4, 2, 1])
_AS_OWN = ALL % BLOCK @ np.array([BLOCK**2, BLOCK, 1])
_FAR = _CORNER > 0


class Nodes:
    """The nodes of blocks (n, 3), those on their far sides included, by their places: first the blocks' own, the first ones of
    all, then the second ones, and so on; then those on the `rim`, which are no block's own.

    `of_block` (125, n) tells where those of each block are, in the order of their coordinates; `owned` is 64 n.
    """

    def __init__(self, blocks: Blocks) -> None:
        count, owned = len(blocks), len(OWN) * len(blocks)
        numbers = blocks.astype(np.int64) // BLOCK @ ALONG
        every, which = np.unique(numbers[:, None] + CORNERS @ ALONG, return_inverse=True)
        which = which.reshape(-1, 8)
        slot = np.full(len(every), -1)
        slot[which[:, 0]] = np.arange(count)
        absent = np.flatnonzero(slot < 0)
        slot[absent] = np.arange(count, len(every))
        self._beside = slot.take(which.T)  # of each block's corners the block there, or one that is absent
        far = self._beside[_CORNER[_FAR]] + (_AS_OWN[_FAR] * len(every))[:, None]
        on_rim = np.zeros((len(OWN), len(every)), dtype=bool)
        on_rim.reshape(-1)[far] = True
        on_rim[:, :count] = False
        rim = np.flatnonzero(on_rim)
        own, cube = np.divmod(rim, len(every))
        first = every[absent] // ALONG[:, None] % ALONG[1] * BLOCK
        place = np.empty(on_rim.shape, dtype=np.int32)
        place[:, :count] = np.arange(owned).reshape(-1, count)
        place.reshape(-1)[rim] = np.arange(owned, owned + len(rim))
        self.count, self.owned = count, owned
        self.of_block = np.empty((len(ALL), count), dtype=np.int32)
        self.of_block[~_FAR], self.of_block[_FAR] = place[:, :count], place.reshape(-1).take(far)
        self._first = np.ascontiguousarray(blocks.T, dtype=np.int64)
        self._rim = first.take(cube - count, axis=1) + OWN.T.take(own, axis=1)
        self._shift: Array | None = None  # of each place, (places, 3), in cells
        self._found = np.zeros(len(self), dtype=bool)

    def __len__(self) -> int:
        return self.owned + self._rim.shape[1]

    def by_block(self, values: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """What is told of places (p,), for all nodes of each block, (125, n)."""
        result = np.empty(self.of_block.shape, dtype=np.uint8)
        result[~_FAR] = values[: self.owned].reshape(len(OWN), -1)
        result[_FAR] = values.take(self.of_block[_FAR])
        return result

    def named(self, places: NDArray[np.integer[Any]]) -> Numbers:
        """The nodes (n, 3) at places (n,)."""
        own, block = np.divmod(places, self.count)
        result = self._first.take(block, axis=1)
        result += OWN.T.take(own, axis=1, mode="clip")
        rim = np.flatnonzero(own >= len(OWN))
        result[:, rim] = self._rim.take(places[rim] - self.owned, axis=1)
        return result.T

    def sampled(self, sampling: Sampling) -> Samples:
        """The field at all nodes, by their places."""
        return np.concatenate([sampling.of_blocks(self._first.T).reshape(-1), sampling.at(self._rim.T)])

    def into_sheets(self, samples: Samples, sampling: Sampling) -> None:
        """Move nodes into sheets that the samples (places,) don't see, and have them see these, in place."""
        found = moves(self.of_block, samples, self.named, sampling)
        if found is not None and len(found.places):
            self._shift = np.zeros((len(self), 3))
            self._shift[found.places, found.axis] = found.shift
            self._found[found.places] = (samples[found.places] > 0) != (found.samples > 0)
            samples[found.places] = found.samples

    def aside(self, near: Indices, far: Indices) -> Array | None:
        """How far the nodes at places (n,) each have moved, (n, 2, 3); None where none has."""
        return None if self._shift is None else np.stack([self._shift[near], self._shift[far]], axis=1)

    def middle(self, one: Indices, other: Indices) -> Array:
        """The numbers (n, 3) of the middles between nodes at places (n,) each."""
        middle = (self.named(one) + self.named(other)) / 2
        return middle if self._shift is None else middle + (self._shift[one] + self._shift[other]) / 2

    def in_sheets(self, one: Indices, other: Indices) -> NDArray[np.intp]:
        """How many of the nodes at places (n,) each have been moved to the other side of the level, (n,)."""
        return self._found[one].astype(np.intp) + self._found[other]

    def bordering(self) -> NDArray[np.bool_]:
        """Whether nodes are on a side beyond which there is no block, by the axis across the side and by place, (3, places)."""
        result = np.zeros((3, len(self)), dtype=bool)
        for axis in range(3):
            ahead = self._beside[4 >> axis]
            first = np.ones(self.count, dtype=bool)
            first[ahead[ahead < self.count]] = False
            for side, last in ((0, first), (BLOCK, ahead >= self.count)):
                result[axis, self.of_block[ALL[:, axis] == side].compress(last, axis=1)] = True
        return result
