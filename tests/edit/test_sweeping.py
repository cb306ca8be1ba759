"""Numbers set in motion: from what they are to the far end of their slider, and back to rest."""

from __future__ import annotations

import pytest

from hqmodel.edit import EditError, animations, get, new_scene, staged
from hqmodel.edit.sweeping import animate, remove_sweep, turntable
from hqmodel.model import FIELDS, Camera, Scene

GAMMA = ("shapes", 0, "strips", 0, "gamma")


@pytest.fixture
def scene() -> Scene:
    return new_scene()


@pytest.mark.parametrize(
    "location", [GAMMA, ("level",), ("slice",), ("shapes", 0, "hardness"), ("shapes", 0, "transform", "translation", 1)]
)
def test_it_begins_as_it_is_and_ends_at_an_end_of_its_slider(scene: Scene, location: tuple[str | int, ...]) -> None:
    moving = animate(scene, location, name="my move")
    (animation,) = animations(moving)
    assert animation.name == "my move"
    assert staged(moving, animation, 0.0) == moving
    key = "".join("[]" if isinstance(step, int) else f".{step}" for step in location).lstrip(".")
    assert get(staged(moving, animation, 1.0), location) in FIELDS[key].slider
    assert moving.changed(animations=()) == scene


def test_a_second_number_joins_with_as_many_values(scene: Scene) -> None:
    first = animate(scene, GAMMA)
    (animation,) = animations(first)
    three = first.changed(
        animations=({**first.animations[0], "sweeps": [{**first.animations[0]["sweeps"][0], "values": [2, 9, 3]}]},)
    )
    both = animate(three, ("level",), index=0)
    (animation,) = animations(both)
    assert [len(sweep.values) for sweep in animation.sweeps] == [3, 3]
    low, middle, high = animation.sweeps[1].values
    assert min(low, high) < middle < max(low, high)


def test_no_number_twice_nor_what_is_no_number(scene: Scene) -> None:
    with pytest.raises(EditError, match="not animated there yet, got level"):
        animate(animate(scene, ("level",)), ("level",), index=0)
    with pytest.raises(EditError, match=r"^shapes\[0\]\.transform\.rotation: expected a number"):
        animate(scene, ("shapes", 0, "transform", "rotation"))


def test_with_its_last_number_the_animation_goes(scene: Scene) -> None:
    both = animate(animate(scene, GAMMA), ("level",), index=0)
    one = remove_sweep(both, 0, 0)
    assert [sweep.path for sweep in animations(one)[0].sweeps] == ["level"]
    assert remove_sweep(one, 0, 0) == scene


def test_a_turntable_ends_where_it_began(scene: Scene) -> None:
    (animation,) = animations(turntable(scene, Camera(azimuth=30.0)))
    (sweep,) = animation.sweeps
    assert sweep.values == (30.0, 390.0)
    assert len(set(animation.phases(8))) == 8, "a loop that closes leaves out its last frame"
