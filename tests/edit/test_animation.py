"""Animations: values between keyframes, phases of frames, scenes and cameras at a phase, faults told by their place."""

from __future__ import annotations

from itertools import pairwise
from math import sqrt
from typing import Any

import pytest

from hqmodel.edit import (
    Animation,
    EditError,
    Sweep,
    add_animation,
    animation_at,
    animations,
    filmed,
    get,
    new_scene,
    remove_animation,
    set_animation,
    staged,
    sweep_of,
)
from hqmodel.files import builtin, dumps, load, parse
from hqmodel.model import Camera, Scene

SCENE = new_scene()
FIGURES = [preset for preset in builtin() if preset.collection == "figures"]


def swept(*values: float, path: str = "gamma", **more: Any) -> Animation:
    return Animation(sweeps=(sweep_of(SCENE, f"{path}={':'.join(map(str, values))}"),), **more)


def with_animation(tree: dict[str, Any]) -> Scene:
    return SCENE.changed(animations=(tree,))


def test_between_keyframes_a_value_goes_along_its_scale() -> None:
    exponents, slices = sweep_of(SCENE, "gamma=2:8:4"), sweep_of(SCENE, "slice=-1:1:0")
    assert (exponents.scale, slices.scale) == ("log", "linear")
    assert [exponents.at(phase) for phase in (0, 0.5, 1)] == [2, 8, 4]
    assert exponents.at(0.25) == pytest.approx(4)
    assert exponents.at(0.75) == pytest.approx(sqrt(32))
    assert [slices.at(phase) for phase in (0, 0.25, 0.5, 0.75, 1)] == [-1, 0, 1, 0.5, 0]


def test_keyframes_are_hit_exactly() -> None:
    sweep = sweep_of(SCENE, "gamma=0.1:0.3:0.7:900")
    assert [sweep.at(phase) for phase in swept(1, 1, 1, 1).keyframes] == [0.1, 0.3, 0.7, 900]


def test_a_scene_at_a_phase_has_every_sweep_s_value() -> None:
    animation = Animation(sweeps=(sweep_of(SCENE, "gamma=1:9"), sweep_of(SCENE, "shapes[0].strips[1].half_width=1:4")))
    scene = staged(SCENE, animation, 0.5)
    assert [strip.gamma for strip in scene.shapes[0].strips] == pytest.approx([3] * len(scene.shapes[0].strips))
    assert [get(scene, f"shapes[0].strips[{i}].half_width") for i in (0, 1)] == pytest.approx([1, 2])
    assert staged(SCENE, animation, 0) == staged(staged(SCENE, animation, 1), animation, 0)


def test_the_camera_is_swept_apart_from_the_scene() -> None:
    animation = swept(0, 90, path="view.camera.azimuth")
    assert staged(SCENE, animation, 0.5) is SCENE
    assert filmed(Camera(elevation=7.0), animation, 0.5) == Camera(azimuth=45.0, elevation=7.0)


@pytest.mark.parametrize("easing", ["linear", "smooth"])
def test_frames_go_forward_and_come_back_the_same_way(easing: Any) -> None:
    once = swept(1, 2, 4, easing=easing, repeat="once").phases(11)
    assert (once[0], once[-1]) == (0, 1)
    assert once[5] == pytest.approx(0.5)
    assert all(a < b for a, b in pairwise(once))
    there = swept(1, 2, 4, easing=easing, repeat="ping-pong").phases(12)
    assert (there[0], there[6], max(there)) == (0, 1, 1)
    assert there[1:6] == there[:6:-1]  # neither end is shown twice


def test_a_smooth_one_rests_at_its_keyframes_and_a_linear_one_nowhere() -> None:
    smooth, linear = (swept(1, 2, 4, easing=easing, repeat="once").phases(201) for easing in ("smooth", "linear"))
    steps = [b - a for a, b in pairwise(smooth)]
    assert max(steps[0], steps[99], steps[100], steps[-1]) < 0.05 * max(steps)
    assert [b - a for a, b in pairwise(linear)] == pytest.approx([1 / 200] * 200)


def test_a_loop_that_ends_as_it_began_leaves_its_end_to_the_next_round() -> None:
    assert swept(2, 8, 2, easing="linear").phases(4) == [0, 0.25, 0.5, 0.75]
    assert swept(0, 360, path="view.camera.azimuth", easing="linear").phases(4) == [0, 0.25, 0.5, 0.75]
    assert swept(2, 8, easing="linear").phases(5) == [0, 0.25, 0.5, 0.75, 1]


@pytest.mark.parametrize("preset", FIGURES, ids=lambda preset: preset.name)
def test_the_figures_animations_are_read_and_written_back_the_same(preset: Any) -> None:
    scene = load(preset.path)
    found = animations(scene)
    assert [animation.plain() for animation in found] == list(scene.animations)
    for animation in found:
        for phase in animation.keyframes:
            staged(scene, animation, phase)


def test_edits_keep_unknown_keys_and_the_others() -> None:
    first = {"name": "a", "note": {"by": None}, "sweeps": [{"path": "gamma", "values": [1, 2], "tint": 3}]}
    scene = add_animation(with_animation(first), swept(1, 2, name="b"))
    scene = set_animation(scene, 0, animation_at(scene, 0).changed(duration=2.5))
    scene = parse(dumps(scene).encode(), "again")
    assert [animation.name for animation in animations(scene)] == ["a", "b"]
    kept = scene.animations[0]
    assert (kept["note"], kept["sweeps"][0]["tint"], kept["duration"]) == ({"by": None}, 3, 2.5)
    assert [animation.name for animation in animations(remove_animation(scene, 0))] == ["b"]
    with pytest.raises(EditError, match="animations"):
        remove_animation(scene, 2)


@pytest.mark.parametrize(
    ("tree", "message"),
    [
        ({}, "animations[0].sweeps: expected a list, got nothing"),
        ({"sweeps": []}, "animations[0].sweeps: expected at least one sweep, got []"),
        (
            {"sweeps": [{"path": "slice", "values": [1, 2, 3]}, {"path": "gamma", "values": [1, 2, -3]}]},
            "animations[0].sweeps[1].values[2]: expected a number from 0.05 to 1000, got -3",
        ),
        (
            {"sweeps": [{"path": "slice", "values": [1, 2, 3]}, {"path": "gamma", "values": [1, 2]}]},
            "animations[0].sweeps[1].values: expected 3 values like the first sweep, got 2",
        ),
        (
            {"sweeps": [{"path": "slice", "values": [1]}]},
            "animations[0].sweeps[0].values: expected at least two values, got [1.0]",
        ),
        (
            {"sweeps": [{"path": "slice", "values": [1, 0], "scale": "log"}]},
            "animations[0].sweeps[0].values[1]: expected a number above 0, as its scale is log, got 0",
        ),
        (
            {"sweeps": [{"path": "slice", "values": [1, 2]}], "easing": "bouncy"},
            'animations[0].easing: expected "linear" or "smooth", got \'bouncy\'',
        ),
        (
            {"sweeps": [{"path": "slice", "values": [1, 2]}], "duration": 0},
            "animations[0].duration: expected a number above 0 and up to 3600, got 0.0",
        ),
        (
            {"sweeps": [{"path": "shapes[9].hardness", "values": [1, 2]}]},
            "animations[0].sweeps[0].path: shapes[9]: expected an index from 0 to 0, got 9",
        ),
    ],
)
def test_what_is_wrong_with_an_animation_is_told_by_its_place(tree: dict[str, Any], message: str) -> None:
    with pytest.raises(EditError) as raised:
        animations(with_animation(tree))
    assert str(raised.value) == message


@pytest.mark.parametrize("path", ["dimension", "name", "shapes", "visible", "shapes[0].strips[0].sign", "transform.rotation[0]"])
def test_what_cannot_change_little_by_little_is_refused(path: str) -> None:
    with pytest.raises(EditError, match="expected the path of a number that can change little by little"):
        sweep_of(SCENE, f"{path}=1:-1")


@pytest.mark.parametrize("text", ["", "gamma", "gamma=1", "=1:2", "gamma=1:b", "slice=0:nan", "slice=0:inf"])
def test_a_text_that_is_no_sweep(text: str) -> None:
    with pytest.raises(EditError, match=r"expected PATH=A:B or more values, such as gamma=1:60, got"):
        sweep_of(SCENE, text)


def test_a_text_is_the_sweep_it_says() -> None:
    assert sweep_of(SCENE, " slice = -1 : .5 ") == Sweep(path="slice", values=(-1.0, 0.5), scale="linear")
