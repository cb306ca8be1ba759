"""Rotations as unit quaternions x, y, z, w: from angles that people can read and back, about an axis, one after another."""

from __future__ import annotations

from collections.abc import Sequence
from math import asin, atan2, copysign, cos, degrees, hypot, radians, remainder, sin

Quaternion = tuple[float, float, float, float]


def angles(rotation: Sequence[float]) -> tuple[float, float, float]:
    """The turns about the world's x, then y, then z axis, in degrees, that make up a unit quaternion x, y, z, w.

    y is within 90 degrees; at 90 the other two turn about the same axis, and x is given all of it.
    """
    x, y, z, w = rotation
    sine = 2 * (w * y - z * x)
    if abs(sine) > 1 - 1e-12:
        return remainder(degrees(2 * atan2(x, w)), 360.0), copysign(90.0, sine), 0.0
    return (
        degrees(atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))),
        degrees(asin(sine)),
        degrees(atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))),
    )


def quaternion(x: float, y: float, z: float) -> Quaternion:
    """The unit quaternion x, y, z, w of turns by these angles, in degrees, about the world's x, then y, then z axis."""
    (a, sa), (b, sb), (c, sc) = ((cos(radians(angle) / 2), sin(radians(angle) / 2)) for angle in (x, y, z))
    return (
        sa * b * c - a * sb * sc,
        a * sb * c + sa * b * sc,
        a * b * sc - sa * sb * c,
        a * b * c + sa * sb * sc,
    )


def about(axis: Sequence[float], angle: float) -> Quaternion:
    """The unit quaternion of a turn by so many degrees about an axis of any length, counter-clockwise seen from its tip."""
    half, length = radians(angle) / 2, hypot(*axis)
    x, y, z = (float(part) / length * sin(half) for part in axis)
    return x, y, z, cos(half)


def composed(second: Sequence[float], first: Sequence[float]) -> Quaternion:
    """The turn that two unit quaternions make one after the other, of length 1 again."""
    x, y, z, w = second
    a, b, c, d = first
    product = (
        w * a + x * d + y * c - z * b,
        w * b - x * c + y * d + z * a,
        w * c + x * b - y * a + z * d,
        w * d - x * a - y * b - z * c,
    )
    length = hypot(*product)
    qx, qy, qz, qw = (part / length for part in product)
    return qx, qy, qz, qw
