"""Gestures on whole shapes: moved, turned and scaled, along an axis when one is locked."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from hqmodel import edit
from hqmodel.model import Scene, Vector, vector

from .aim import Pixels
from .gesture import Gesture, Values, onto_grid, rounded

AXES: dict[str, Vector] = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
TURN_STEP, SCALE_STEP = 15.0, 0.1


@dataclass(frozen=True)
class Arrange(Gesture):
    """What move, turn and scale have in common: shapes, a pivot, where the pointer began, and an axis when one is locked."""

    shapes: tuple[int, ...]
    pivot: Vector
    start: Pixels
    axis: str = ""

    def locked(self, axis: str) -> Arrange:
        """The same along or about one axis, x, y or z; the same axis again frees it."""
        return replace(self, axis="" if axis == self.axis else axis)

    def _along(self) -> str:
        return f"   along {self.axis}" if self.axis else ""


@dataclass(frozen=True)
class Move(Arrange):
    """Shapes moved in the picture's plane, or along an axis."""

    label: ClassVar[str] = "Move"

    def measured(self, moved: Pixels) -> Values:
        if self.axis:
            return (self.aim.along(self.pivot, AXES[self.axis], moved),)
        return vector(self.aim.across(self.pivot, moved))

    def snapped(self, values: Values) -> Values:
        """Where the active shape's own origin lies on the grid."""
        at = self.before.shapes[self.shapes[-1]].transform.translation
        return onto_grid(values, (at["xyz".index(self.axis)],) if self.axis else at, self.aim.step)

    def scene(self, values: Values) -> Scene:
        by = np.array(AXES[self.axis]) * values[0] if self.axis else np.array(values)
        return edit.move_shapes(self.before, self.shapes, by)

    def told(self, values: Values, after: Scene) -> str:
        return "move " + "  ".join(f"{value:+.3f}" for value in values) + self._along()

    def typed(self, number: float) -> Values:
        return (number,) if self.axis else (number, 0.0, 0.0)


@dataclass(frozen=True)
class Turn(Arrange):
    """Shapes turned about the line of sight, or about an axis."""

    label: ClassVar[str] = "Turn"

    def measured(self, moved: Pixels) -> Values:
        angle = self.aim.turned(self.pivot, self.start, moved)
        back = self.aim.camera.axes()[2]
        return (angle if not self.axis or back @ AXES[self.axis] >= 0 else -angle,)

    def snapped(self, values: Values) -> Values:
        return rounded(values, TURN_STEP)

    def scene(self, values: Values) -> Scene:
        axis = AXES[self.axis] if self.axis else self.aim.camera.axes()[2]
        if self.before.dimension == 2:
            axis = AXES["z"]
        return edit.turn_shapes(self.before, self.shapes, edit.about(tuple(axis), values[0]), self.pivot)

    def told(self, values: Values, after: Scene) -> str:
        return f"turn {values[0]:+.1f}°" + (f"   about {self.axis}" if self.axis else "")


@dataclass(frozen=True)
class Scale(Arrange):
    """Shapes made larger or smaller, or stretched along an axis."""

    label: ClassVar[str] = "Scale"

    def measured(self, moved: Pixels) -> Values:
        return (self.aim.spread(self.pivot, self.start, moved),)

    def snapped(self, values: Values) -> Values:
        return (max(SCALE_STEP, *rounded(values, SCALE_STEP)),)

    def scene(self, values: Values) -> Scene:
        if self.axis:
            return edit.stretch_shapes(self.before, self.shapes, AXES[self.axis], values[0], self.pivot)
        return edit.scale_shapes(self.before, self.shapes, values[0], self.pivot)

    def told(self, values: Values, after: Scene) -> str:
        return f"scale {values[0]:.3f}{self._along()}"
