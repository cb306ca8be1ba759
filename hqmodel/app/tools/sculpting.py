"""Gestures on the clay: planes pushed and tilted, exponents and blends softened, the body patted and chopped."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import atan2, cos, degrees, exp, hypot, log, radians, sin
from typing import ClassVar, Literal

import numpy as np

from hqmodel import edit
from hqmodel.field import Region, rotation_matrix
from hqmodel.model import FIELDS, Scene, Vector

from .aim import Array, Pixels
from .gesture import Gesture, Values, onto_grid, rounded
from .grip import Grip

Way = Literal["one", "both", "slide"]
WAYS: tuple[Way, ...] = ("one", "both", "slide")
# What angles, in degrees, and ratios are snapped to.
TILT_STEP, LINE_STEP, _RATIO = 5.0, 15.0, 2.0**0.25
# Pixels that multiply an exponent by e, and that a line must have to cut.
_EXPONENT_PIXELS, _SHORT = 90.0, 8.0
_GAMMA = FIELDS["shapes[].strips[].gamma"]


@dataclass(frozen=True)
class Push(Gesture):
    """One plane moved along its normal, the opposite one staying; or both; or the strip as a whole."""

    grip: Grip
    way: Way = "one"
    label: ClassVar[str] = "Push plane"

    def measured(self, moved: Pixels) -> Values:
        return (self.aim.along(self.grip.point, self.grip.face(self.before).normal, moved),)

    def snapped(self, values: Values) -> Values:
        """Where the plane is a multiple of the grid's step away from the world's origin."""
        face = self.grip.face(self.before)
        return onto_grid(values, (float(face.normal @ face.middle),), self.aim.step)

    def scene(self, values: Values) -> Scene:
        grip, (distance,) = self.grip, values
        match self.way:
            case "one":
                after = edit.push_plane(self.before, grip.shape, grip.strip, grip.side, distance)
            case "both":
                after = edit.spread_planes(self.before, grip.shape, grip.strip, distance)
            case "slide":
                after = edit.slide_strip(self.before, grip.shape, grip.strip, grip.side, distance)
        return edit.remove_strip(after, grip.shape, grip.strip) if self._out(after) else after

    def told(self, values: Values, after: Scene) -> str:
        if len(after.shapes[self.grip.shape].strips) < len(self.before.shapes[self.grip.shape].strips):
            return "out of the body: let go to remove"
        strip = after.shapes[self.grip.shape].strips[self.grip.strip]
        words = {"one": "plane", "both": "both planes", "slide": "strip"}[self.way]
        return f"{words} {values[0]:+.3f}   half-width {strip.half_width:.3f}"

    def other(self) -> Gesture:
        return replace(self, way=WAYS[(WAYS.index(self.way) + 1) % len(WAYS)])

    def _out(self, after: Scene) -> bool:
        """Whether neither plane bites any more, where one did."""
        both = [replace(self.grip, side=side) for side in (1, -1)]
        return any(len(one.face(self.before).polygon) for one in both) and not any(len(one.face(after).polygon) for one in both)


@dataclass(frozen=True)
class Tilt(Gesture):
    """A plane tipped about a pivot by pulling a point of the ring around it up or down."""

    grip: Grip
    pivot: Vector
    arm: Vector
    label: ClassVar[str] = "Tilt plane"

    def measured(self, moved: Pixels) -> Values:
        arm, normal = np.array(self.arm), self.grip.face(self.before).normal
        rise = self.aim.along(np.array(self.pivot) + arm, normal, moved)
        return (degrees(atan2(rise, float(np.linalg.norm(arm)))),)

    def snapped(self, values: Values) -> Values:
        return rounded(values, TILT_STEP)

    def scene(self, values: Values) -> Scene:
        grip, image = self.grip, np.array(self.grip.image)
        axis = np.cross(np.array(self.arm) * image, grip.face(self.before).normal * image)
        turn = rotation_matrix(edit.about(tuple(axis), values[0]))
        return edit.tilt_strip(self.before, grip.shape, grip.strip, np.array(self.pivot) * image, turn)

    def told(self, values: Values, after: Scene) -> str:
        return f"tilt {values[0]:+.1f}°"


@dataclass(frozen=True)
class Soften(Gesture):
    """Exponents made larger (to the right) or smaller: those of one strip, or of a whole shape."""

    shape: int
    strip: int
    whole: bool = False
    label: ClassVar[str] = "Exponent"

    @property
    def gamma(self) -> float:
        return self.before.shapes[self.shape].strips[self.strip].gamma

    def measured(self, moved: Pixels) -> Values:
        return (self._permitted(self.gamma * _factor(moved)),)

    def snapped(self, values: Values) -> Values:
        return (self._permitted(_RATIO ** round(log(values[0], _RATIO))),)

    def scene(self, values: Values) -> Scene:
        if not _GAMMA.permits(values[0]):
            raise edit.EditError(f"exponent: expected {_GAMMA.expected()}, got {values[0]:g}")
        return edit.scale_exponents(self.before, self.shape, values[0] / self.gamma, None if self.whole else [self.strip])

    def told(self, values: Values, after: Scene) -> str:
        return f"exponent {values[0]:.3g}{'   whole shape' if self.whole else ''}"

    def other(self) -> Gesture:
        return replace(self, whole=not self.whole)

    def _permitted(self, gamma: float) -> float:
        return min(max(gamma, _GAMMA.low), _GAMMA.high)


@dataclass(frozen=True)
class Pat(Gesture):
    """The clay pressed flat where the pointer is: the hand pushes into the body, from straight ahead with any motion."""

    shape: int
    point: Vector
    normal: Vector
    image: Vector
    gamma: float = edit.PAT
    label: ClassVar[str] = "Pat"

    def measured(self, moved: Pixels) -> Values:
        if self.aim.end_on(self.point, self.normal):
            return (hypot(*moved) * self.aim.per_pixel(self.point),)
        return (max(0.0, -self.aim.along(self.point, self.normal, moved)),)

    def snapped(self, values: Values) -> Values:
        return rounded(values, self.aim.step)

    def scene(self, values: Values) -> Scene:
        if values[0] <= 0:
            return self.before
        image = np.array(self.image)
        return edit.pat(self.before, self.shape, image * self.point, image * self.normal, values[0], self.gamma)

    def told(self, values: Values, after: Scene) -> str:
        return f"depth {values[0]:.3f}   exponent {self.gamma:.3g}"


@dataclass(frozen=True)
class Chop(Gesture):
    """A line drawn across the view cuts these shapes with the plane through it and the eye; the smaller piece goes."""

    shapes: tuple[int, ...]
    start: Pixels
    body: Region
    gamma: float = edit.CHOP
    flipped: bool = False
    label: ClassVar[str] = "Chop"

    def measured(self, moved: Pixels) -> Values:
        return moved

    def snapped(self, values: Values) -> Values:
        """To lines at every 15 degrees."""
        length, angle = hypot(*values), radians(LINE_STEP * round(degrees(atan2(values[1], values[0])) / LINE_STEP))
        return length * cos(angle), length * sin(angle)

    def scene(self, values: Values) -> Scene:
        if hypot(*values) < _SHORT:
            return self.before
        point, normal = self.plane(values)
        return edit.chop(self.before, self.shapes, point, normal, self.gamma)

    def plane(self, values: Values) -> tuple[Array, Array]:
        """A point of the cutting plane and its normal (3,), towards what goes."""
        ends = [self.start, (self.start[0] + values[0], self.start[1] + values[1])]
        origins, rays = self.aim.camera.rays(ends, self.aim.size)
        across = origins[1] + rays[1] - origins[0] - rays[0]
        normal = np.cross(across, rays[0])
        normal /= np.linalg.norm(normal)
        keeps = float(normal @ (self.body.centre - origins[0])) < 0
        return origins[0], normal if keeps != self.flipped else -normal

    def told(self, values: Values, after: Scene) -> str:
        return "draw a line across the body" if hypot(*values) < _SHORT else "Tab: the other piece goes"

    def typed(self, number: float) -> Values:
        """A line at this angle in degrees, counter-clockwise from the right."""
        return 100 * cos(radians(number)), -100 * sin(radians(number))

    def other(self) -> Gesture:
        return replace(self, flipped=not self.flipped)


@dataclass(frozen=True)
class Harden(Gesture):
    """How abruptly a shape blends with the others."""

    shape: int
    label: ClassVar[str] = "Hardness"

    def measured(self, moved: Pixels) -> Values:
        return (self.before.shapes[self.shape].hardness * _factor(moved),)

    def snapped(self, values: Values) -> Values:
        return (_RATIO ** round(log(values[0], _RATIO)),)

    def scene(self, values: Values) -> Scene:
        return edit.put(self.before, ("shapes", self.shape, "hardness"), values[0])

    def told(self, values: Values, after: Scene) -> str:
        return f"hardness {values[0]:.3g}"


def _factor(moved: Pixels) -> float:
    """What a pull to the right, or up, multiplies by."""
    return exp(min(max((moved[0] - moved[1]) / _EXPONENT_PIXELS, -50.0), 50.0))
