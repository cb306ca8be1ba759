"""Random scenes over all that the format permits, driven by the table of fields."""

from __future__ import annotations

from math import inf
from typing import Any

from hypothesis import strategies as st

from hqmodel.model import FIELDS, Number, Scene, Shape

# Beyond the sliders, but short of where sums of squares overflow.
LARGE = 1e6
# Of random numbers.
SEEDS = st.integers(0, 2**32 - 1)


def numbers(number: Number) -> st.SearchStrategy[float]:
    """What the format permits in a field: comfortable values, the limits themselves, and the spicy rest."""
    low = max(number.low, -LARGE) if number.low > -inf else -LARGE
    high = min(number.high, LARGE)
    if number.above:
        low = 1e-6
    edges = [value for value in (low, high, 0.0, -0.0, 1.0) if number.permits(value)]
    anywhere = st.floats(low, high, allow_subnormal=False)
    return st.one_of(st.floats(*number.slider), st.sampled_from(edges), anywhere)


def field(key: str) -> st.SearchStrategy[float]:
    """What the format permits in the field of that `FIELDS` key."""
    return numbers(FIELDS[key])


def vector(key: str) -> st.SearchStrategy[list[float]]:
    """A vector of what the format permits in each component."""
    count = len(FIELDS[key].parts)
    return st.lists(field(key), min_size=count, max_size=count)


# Keys that no version of the format has, with values of every kind that JSON knows.
_LEAVES = st.none() | st.booleans() | st.integers(-(2**60), 2**60) | st.text(max_size=8)
PLAIN = st.recursive(
    _LEAVES | st.floats(allow_nan=False, allow_infinity=False),
    lambda inner: st.lists(inner, max_size=2) | st.dictionaries(st.text(max_size=3), inner, max_size=2),
    max_leaves=3,
)
UNKNOWN: st.SearchStrategy[dict[str, Any]] = st.just({}) | st.dictionaries(
    st.sampled_from(["x-note", "x-ä", "x- _"]), PLAIN, min_size=1, max_size=2
)


@st.composite
def strips(draw: st.DrawFn, dimension: int) -> dict[str, Any]:
    normal = draw(vector("shapes[].strips[].normal[]").filter(lambda n: any(n[:dimension])))
    if dimension == 2:
        normal = draw(st.sampled_from([normal[:2], [*normal[:2], 0.0]]))
    keys = ("slice", "offset", "half_width", "gamma")
    fields = {key: draw(field(f"shapes[].strips[].{key}")) for key in draw(st.sets(st.sampled_from(keys)))}
    return {"normal": normal, **fields, "sign": draw(st.sampled_from([1, -1])), **draw(UNKNOWN)}


@st.composite
def shapes(draw: st.DrawFn, dimension: int) -> dict[str, Any]:
    members = draw(st.lists(strips(dimension), min_size=1, max_size=4))
    shape: dict[str, Any] = {key: draw(field(f"shapes[].{key}")) for key in ("coefficient", "hardness", "constant")}
    shape |= {"strips": members, "name": draw(st.text(max_size=6)), "visible": draw(st.booleans())}
    shape["mirror"] = draw(st.lists(st.sampled_from("xyz"), unique=True))
    shape["color"] = draw(vector("shapes[].color[]"))
    shape["transform"] = {key: draw(vector(f"shapes[].transform.{key}[]")) for key in ("translation", "scale")}
    shape["transform"]["rotation"] = draw(st.sampled_from([[0, 0, 0, 1], [0.5, 0.5, -0.5, 0.5], [0.6, 0, 0, 0.8]]))
    if draw(st.booleans()):
        gamma = draw(field("shapes[].strips[].gamma"))
        shape["groups"] = {"rim": {"gamma": draw(field("shapes[].groups{}.gamma")), "sign": draw(st.sampled_from([1, -1]))}}
        for strip in members[: draw(st.integers(1, len(members)))]:
            strip.update(group="rim", gamma=gamma, sign=1)
    return {**shape, **draw(UNKNOWN)}


@st.composite
def presets(draw: st.DrawFn) -> dict[str, Any]:
    """A valid preset as plain data, unknown keys included."""
    dimension = draw(st.sampled_from([2, 3, 3]))
    tree: dict[str, Any] = {"format": "hqmodel", "version": 1, "dimension": dimension, "name": draw(st.text(max_size=8))}
    tree |= {key: draw(field(key)) for key in ("slice", "level")}
    tree["shapes"] = draw(st.lists(shapes(dimension), max_size=3))
    if draw(st.booleans()):
        tree["bounds"] = [[-2, -2.5, -1e-3], [2, 1e3, 4]]
    return {**tree, **draw(UNKNOWN)}


def scenes() -> st.SearchStrategy[Scene]:
    """A valid scene."""
    return presets().map(Scene.model_validate)


def solid_shapes() -> st.SearchStrategy[Shape]:
    """A valid shape of three dimensions."""
    return shapes(3).map(Shape.model_validate)
