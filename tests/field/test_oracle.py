"""The field against the format's own definition, written out plainly in 60 digits."""

from __future__ import annotations

from itertools import product

import mpmath
import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from hqmodel.field import Terms, log_ratio, value
from hqmodel.field.terms import rotation_matrix
from hqmodel.model import Scene, Shape

from ..strategies import scenes

mpmath.mp.dps = 60
points = st.tuples(*[st.floats(-3, 3)] * 3)


def plain_sum(shape: Shape, t: float, x: list[float]) -> mpmath.mpf:
    """H at a world point, strip by strip."""
    turn = rotation_matrix(shape.transform.rotation).T.tolist()
    moved = [mpmath.mpf(a) - b for a, b in zip(x, shape.transform.translation, strict=True)]
    own = [
        mpmath.fsum(a * b for a, b in zip(row, moved, strict=True)) / s
        for row, s in zip(turn, shape.transform.scale, strict=True)
    ]
    total, inner = mpmath.mpf(0), dict.fromkeys(shape.groups, mpmath.mpf(0))
    exponent = {}
    for strip in shape.strips:
        plane = mpmath.fsum(mpmath.mpf(n) * p for n, p in zip(strip.normal, own, strict=True))
        h = abs(plane + mpmath.mpf(strip.slice) * t + strip.offset) / strip.half_width
        if strip.group is None:
            total += strip.sign * h**strip.gamma
        else:
            inner[strip.group] += h**strip.gamma
            exponent[strip.group] = strip.gamma
    for name, g in exponent.items():
        group = shape.groups[name]
        total += group.sign * inner[name] ** (mpmath.mpf(group.gamma) / g)
    return total


def plain_terms(scene: Scene, x: tuple[float, ...]) -> list[tuple[mpmath.mpf, mpmath.mpf]]:
    """The terms of eq. 44 at a world point, each with how much of it a relative error of 1 in H and its factors is worth."""
    terms = []
    for shape in scene.shapes:
        if not shape.visible:
            continue
        for signs in product(*[(1, -1) if axis in shape.mirror else (1,) for axis in "xyz"]):
            h = plain_sum(shape, scene.slice, [s * c for s, c in zip(signs, x, strict=True)])
            term = shape.coefficient * mpmath.exp(shape.hardness * (shape.constant - h))
            terms.append((term, abs(term) * (1 + shape.hardness * (abs(shape.constant) + condition(shape, scene.slice, x)))))
    return terms


def condition(shape: Shape, t: float, x: tuple[float, ...]) -> mpmath.mpf:
    """How much H moves at most for a relative error of 1 in what every h is added up from."""
    reach = 2 * (sum(map(abs, x)) + sum(map(abs, shape.transform.translation))) / min(shape.transform.scale)
    total = mpmath.mpf(0)
    for strip in shape.strips:
        size = (reach * max(map(abs, strip.normal)) + abs(strip.slice * t) + abs(strip.offset)) / strip.half_width
        outer = shape.groups[strip.group].gamma if strip.group is not None else strip.gamma
        total += 1000 * max(outer, 1) * (1 + mpmath.mpf(size)) ** outer * mpmath.mpf(4) ** (outer / strip.gamma)
    return total


@given(scenes(), points)
def test_the_field_is_what_the_format_says(scene: Scene, point: tuple[float, float, float]) -> None:
    terms = plain_terms(scene, point)
    exact = mpmath.fsum(term for term, _ in terms) - mpmath.mpf(scene.level)
    doubt = mpmath.mpf("1e-15") * mpmath.fsum([abs(scene.level), *(worth for _, worth in terms)])
    with np.errstate(all="raise", under="ignore"):
        got, ratio = float(value(Terms.of(scene), point)), float(log_ratio(Terms.of(scene), point))
    assert not np.isnan(ratio)
    if abs(exact) < mpmath.mpf("1e300"):
        assert abs(got - exact) <= doubt + mpmath.mpf("1e-300")
    if abs(exact) > doubt:
        assert np.sign(got) in (0, mpmath.sign(exact))
        assert np.sign(ratio) == mpmath.sign(exact)
