"""Frames as edits: read out, put right, turned and replaced, and every other field left alone."""

from __future__ import annotations

from collections.abc import Callable
from math import pi

import numpy as np
import pytest
from numpy.random import default_rng

from hqmodel.edit import EditError, frame_of, framed_scene, make_orthonormal, replace_frame, set_frame, turn_frame
from hqmodel.edit.frames import STARTS
from hqmodel.field import Terms, frame_residual, make_frame, value
from hqmodel.model import Group, Scene, Shape, Strip


def odd() -> Scene:
    """Five strips in no special frame, two of them a group, with offsets, widths and keys of somebody else's."""
    rng = default_rng(1)
    rows = rng.normal(size=(5, 4)).tolist()
    strips = [
        Strip.model_validate({"normal": row[:3], "slice": row[3], "offset": 0.1 * i, "half_width": 1 + i, "note": i})
        for i, row in enumerate(rows)
    ]
    strips = [strip.changed(group="rim") if i < 2 else strip for i, strip in enumerate(strips)]
    return Scene(shapes=(Shape(strips=(Strip(normal=(1, 0, 0)),)), Shape(strips=tuple(strips), groups={"rim": Group(gamma=9.0)})))


def rest(scene: Scene) -> list[dict[str, object]]:
    """All that a frame doesn't hold."""
    return [strip.model_dump(exclude={"normal", "slice"}) for strip in scene.shapes[1].strips]


def test_a_frame_put_back_changes_nothing() -> None:
    assert set_frame(odd(), 1, frame_of(odd(), 1)) == odd()


def test_orthonormal_and_nothing_else() -> None:
    made = make_orthonormal(odd(), 1)
    assert frame_residual(frame_of(made, 1)) < 1e-12
    assert rest(made) == rest(odd())
    assert made.shapes[0] == odd().shapes[0]
    assert made.shapes[1].groups == odd().shapes[1].groups


def test_turning_back_undoes_a_turn() -> None:
    there = turn_frame(odd(), 1, "xt", 0.4)
    assert rest(there) == rest(odd())
    assert not np.allclose(frame_of(there, 1), frame_of(odd(), 1))
    np.testing.assert_allclose(frame_of(turn_frame(there, 1, "xt", -0.4), 1), frame_of(odd(), 1), atol=1e-14)


def test_a_slice_tipped_over_is_a_slice_of_the_same_shape() -> None:
    """After a quarter turn from x to t the section at t = 0 is what stood at x = 0."""
    scene = framed_scene("random", 3.0, terms=6, seed=8)
    turned = turn_frame(scene, 0, "xt", pi / 2)
    y, z, t = default_rng(3).normal(size=(3, 40)) * 0.5
    for a, b, c in zip(y, z, t, strict=True):
        before = value(Terms.of(scene.changed(slice=float(c))), (0.0, a, b))
        assert value(Terms.of(turned), (-c, a, b)) == pytest.approx(before, abs=1e-12)


def test_another_frame_brings_its_own_strips() -> None:
    made = replace_frame(odd(), 1, make_frame("ico6"))
    np.testing.assert_array_equal(frame_of(made, 1), make_frame("ico6"))
    assert made.shapes[1].groups == {}
    assert {(strip.gamma, strip.offset, strip.half_width, strip.group) for strip in made.shapes[1].strips} == {
        (2.0, 0.0, 1.0, None)
    }
    assert made.shapes[0] == odd().shapes[0]


@pytest.mark.parametrize("name", STARTS)
def test_every_start_is_a_body_about_its_middle(name: str) -> None:
    scene = framed_scene(name, 60.0)
    assert scene.dimension == (2 if name == "simplex3" else 3)
    assert {strip.gamma for strip in scene.shapes[0].strips} == {60.0}
    assert value(Terms.of(scene), (0.0, 0.0, 0.0)) > 0


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda: frame_of(odd(), 2), "shapes[2]: expected an index from 0 to 1, got 2"),
        (lambda: set_frame(odd(), 1, make_frame("cube")), "shapes[1].strips: expected 3 strips, got 5"),
        (lambda: make_orthonormal(set_frame(odd(), 1, np.ones((5, 4))), 1), "shapes[1].strips: expected 4 independent columns"),
        (lambda: turn_frame(framed_scene("cube"), 0, "xt", pi / 2), "shapes[0].strips[0].normal: expected a normal that is not"),
        (
            lambda: turn_frame(framed_scene("simplex3"), 0, "xz", 0.1),
            "shapes[0].strips[0].normal[2]: expected 0 in two",
        ),
        (lambda: framed_scene("cub"), "frame: expected one of simplex3, cube, "),
        (lambda: framed_scene("random", terms=3), "terms: expected at least 4 terms"),
        (lambda: framed_scene("random", terms=2000), "shapes: expected at most 1024 strips in all, got 2000"),
        (lambda: framed_scene("cube", 0.0), "shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got 0.0"),
    ],
)
def test_edits_that_cannot_be_made(edit: Callable[[], object], message: str) -> None:
    with pytest.raises(EditError) as told:
        edit()
    assert str(told.value).startswith(message)
    assert "\n" not in str(told.value)
