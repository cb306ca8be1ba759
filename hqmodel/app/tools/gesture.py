"""A gesture remembers the scene it began with and says what a pull of the hand, or a typed number, makes of it.

It is pulled by `moved`, the pixels (right, down) that the hand has gone since it began; that gives `values`, numbers in words the
artist knows, and those give the scene. So a number can be typed instead, or snapped to a step.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import ClassVar

from hqmodel.model import Scene

from .aim import Aim, Pixels

Values = tuple[float, ...]

# A motion of less than this share of a step is none.
_STILL = 1e-3


@dataclass(frozen=True)
class Gesture(ABC):
    """One drag, from the scene it began with, seen through `aim`."""

    before: Scene
    aim: Aim
    label: ClassVar[str]

    @abstractmethod
    def measured(self, moved: Pixels) -> Values:
        """What the pull comes to."""

    @abstractmethod
    def snapped(self, values: Values) -> Values:
        """The nearest round values."""

    @abstractmethod
    def scene(self, values: Values) -> Scene:
        """What becomes of the scene. Raises edit.EditError where it can't be."""

    @abstractmethod
    def told(self, values: Values, after: Scene) -> str:
        """The values, and what they have made of the scene, as the artist reads them."""

    def typed(self, number: float) -> Values:
        """The values that a typed number stands for."""
        return (number,)

    def other(self) -> Gesture:
        """The next way of doing the same, for the Tab key; itself where there is only one."""
        return self


@dataclass(frozen=True)
class Held:
    """A gesture under way: how far it is pulled, whether to snap, and the number being typed instead, as text."""

    gesture: Gesture
    moved: Pixels = (0.0, 0.0)
    snap: bool = False
    typed: str = ""

    @property
    def values(self) -> Values:
        """What the gesture has come to."""
        try:
            return self.gesture.typed(float(self.typed))
        except ValueError:  # nothing is typed, or no number yet
            values = self.gesture.measured(self.moved)
            return self.gesture.snapped(values) if self.snap else values

    def pulled(self, by: Pixels, snap: bool) -> Held:
        """The hand has moved on by so many pixels."""
        return replace(self, moved=(self.moved[0] + by[0], self.moved[1] + by[1]), snap=snap)

    @property
    def scene(self) -> Scene:
        """What becomes of the scene. Raises edit.EditError where it can't be."""
        return self.gesture.scene(self.values)

    def told(self, after: Scene) -> str:
        """What to show beside the pointer while the scene is this one."""
        told = self.gesture.told(self.values, after)
        return f"[{self.typed}]  {told}" if self.typed else told


def rounded(values: Values, step: float) -> Values:
    """Each to the nearest multiple of the step."""
    return tuple(round(value / step) * step for value in values)


def onto_grid(values: Values, start: Values, step: float) -> Values:
    """Each so that what moves by it, from `start` on, ends at a multiple of the step; what doesn't move stays where it is."""
    moves = zip(values, start, strict=True)
    return tuple(round((at + by) / step) * step - at if abs(by) > _STILL * step else by for by, at in moves)
