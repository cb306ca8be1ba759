"""Each gesture does what it promises, in numbers; Tab, axes and typed values included."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from hqmodel import edit
from hqmodel.app.selection import Selection
from hqmodel.app.tools import reach
from hqmodel.app.tools.aim import Aim
from hqmodel.app.tools.arranging import Move, Scale, Turn
from hqmodel.app.tools.gesture import Gesture, Held
from hqmodel.app.tools.grip import Grip, grip_at, outward
from hqmodel.app.tools.handles import Part, handles
from hqmodel.app.tools.kit import Kit
from hqmodel.app.tools.sculpting import Chop, Harden, Pat, Push, Soften, Tilt, Way
from hqmodel.field import Terms, value, world_planes
from hqmodel.model import Camera, Scene

AIM = Aim(Camera(distance=7.0, azimuth=25.0, elevation=25.0), (800, 600))
BLOCK = Scene(shapes=(edit.new_shape("block"),))
FRONT = (0.2, -1.0, 0.1)
NOTHING = Selection()
IMAGE = (-1.0, 1.0, 1.0)


def held(gesture: Gesture | None, *moved: float, snap: bool = False, typed: str = "") -> Held:
    assert gesture is not None
    return Held(gesture, (moved[0], moved[1]) if moved else (0.0, 0.0), snap, typed)


def taken(kit: Kit, scene: Scene, point: tuple[float, float, float], selection: Selection = NOTHING) -> Gesture | None:
    x, y = AIM.pixel(point)
    return reach.taken(kit, scene, selection, AIM, (float(x), float(y)), grip_at(scene, point), None)


def test_the_grip_is_the_plane_under_the_point() -> None:
    assert grip_at(BLOCK, FRONT) == Grip(0, 1, -1, FRONT)
    assert grip_at(BLOCK, (0.1, 0.2, 1.0)) == Grip(0, 2, 1, (0.1, 0.2, 1.0))
    assert grip_at(Scene(shapes=()), FRONT) is None
    mirrored = edit.put(edit.move_shapes(BLOCK, [0], (3, 0, 0)), "mirror", ["x"])
    grip = grip_at(mirrored, (-4.0, 0.1, 0.2))
    assert grip is not None
    assert (grip.strip, grip.side, grip.image) == (0, 1, (-1, 1, 1))
    assert np.allclose(grip.face(mirrored).normal, (-1, 0, 0))
    assert np.allclose(outward(BLOCK, FRONT), (0, -1, 0), atol=1e-6)


def test_faces_push_and_tab_changes_what_moves() -> None:
    gesture = taken(Kit(), BLOCK, FRONT)
    assert isinstance(gesture, Push)
    moved = AIM.pixel((0.2, -1.3, 0.1)) - AIM.pixel(FRONT)
    assert held(gesture, *moved).values == pytest.approx((0.3,))
    ways = [gesture, gesture.other(), gesture.other().other()]
    widths = [held(one, *moved).scene.shapes[0].strips[1].half_width for one in ways]
    assert widths == pytest.approx([1.15, 1.3, 1.0])
    assert gesture.other().other().other() == gesture
    assert held(gesture, *moved, typed="0.5").values == (0.5,)
    assert held(gesture, *moved, typed="-").values == held(gesture, *moved).values, "a sign alone is no number yet"
    pushed = held(gesture, *moved)
    assert "half-width 1.150" in pushed.told(pushed.scene)
    assert held(gesture, typed="0.5").told(BLOCK).startswith("[0.5]")


def test_a_mirrored_face_is_pushed_outwards_too() -> None:
    mirrored = edit.put(edit.move_shapes(BLOCK, [0], (3, 0, 0)), "mirror", ["x"])
    gesture = taken(Kit(), mirrored, (-4.0, 0.1, 0.2))
    normals, offsets = world_planes(held(gesture, typed="0.5").scene.shapes[0], 0.0)
    assert (1 - offsets[0]) / normals[0][0] == pytest.approx(4.5)


def test_patting_needs_clay_and_follows_the_kit() -> None:
    gesture = taken(Kit("pat", pat=30.0), BLOCK, FRONT)
    assert isinstance(gesture, Pat)
    after = held(gesture, typed="0.2").scene
    assert after.shapes[0].strips[3].gamma == 30.0
    assert abs(float(value(Terms.of(after), (0.2, -0.8, 0.1)))) < 1e-6
    assert held(gesture, typed="0").scene is BLOCK
    x, y, z = (float(part) for part in AIM.camera.axes()[2])
    ahead = replace(gesture, normal=(x, y, z))
    assert held(ahead, 3.0, 4.0).values == pytest.approx((5 * AIM.per_pixel(FRONT),)), "straight ahead any motion presses"


def test_a_chop_takes_the_smaller_piece_and_tab_the_other() -> None:
    gesture = taken(Kit("chop"), BLOCK, (-1.5, 0.0, 0.5))
    assert isinstance(gesture, Chop)
    assert held(gesture, 3.0, 0.0).scene is BLOCK, "a line needs some length"
    after, other = held(gesture, 300.0, 0.0).scene, held(gesture.other(), 300.0, 0.0).scene
    inside = [[bool(value(Terms.of(scene), (0, 0, z)) > 0) for z in (-0.5, 0.8)] for scene in (after, other)]
    assert inside == [[True, False], [False, True]]
    assert held(gesture, 300.0, 20.0, snap=True).values[1] == pytest.approx(0)
    two = edit.move_shapes(edit.add_shape(BLOCK, edit.new_shape("ball")), [1], (0, 0, 0.1))
    only = taken(Kit("chop"), two, (-1.5, 0.0, 0.5), Selection((1,)))
    assert [len(shape.strips) for shape in held(only, 300.0, 0.0).scene.shapes] == [3, 4], "only what is selected is cut"


def test_exponents() -> None:
    gesture = taken(Kit("soften"), BLOCK, FRONT)
    assert isinstance(gesture, Soften)
    assert [strip.gamma for strip in held(gesture, typed="6").scene.shapes[0].strips] == pytest.approx([20, 6, 20])
    assert [strip.gamma for strip in held(gesture.other(), typed="10").scene.shapes[0].strips] == pytest.approx([10, 10, 10])
    assert held(gesture, 1e5, 0.0).values == (1000.0,)
    with pytest.raises(edit.EditError, match=r"expected a number from 0\.05 to 1000, got 0"):
        gesture.scene((0.0,))
    assert held(Harden(BLOCK, AIM, 0), typed="3").scene.shapes[0].hardness == 3


def test_handles_lie_on_the_face_that_faces_the_camera() -> None:
    known = handles(BLOCK, 0, 1, AIM)
    assert known is not None
    assert known.grip.side == -1
    assert known.at(tuple(known.middle)) == "exponent"
    assert known.at(tuple(known.arrow[1])) == "push"
    assert known.at(tuple(known.ring[10])) == "tilt"
    assert known.at((0.0, 0.0)) is None
    tilt = known.taken("tilt", BLOCK, AIM, tuple(known.ring[0]), "one")
    assert isinstance(tilt, Tilt)
    normals, _ = world_planes(held(tilt, typed="20").scene.shapes[0], 0.0)
    assert np.degrees(np.arccos(abs(normals[1][1]))) == pytest.approx(20)
    assert handles(BLOCK, 0, 1, Aim(replace(AIM.camera, distance=0.5), AIM.size)) is None, "behind the eye there is none"


def test_the_arm_that_is_pulled_out_comes_out() -> None:
    known = handles(BLOCK, 0, 1, AIM)
    assert known is not None
    for corner in (0, 16, 32, 48):
        tilt = known.taken("tilt", BLOCK, AIM, tuple(known.ring[corner]), "one")
        normals, offsets = world_planes(held(tilt, typed="10").scene.shapes[0], 0.0)
        arm = known.face.middle + known.arms[corner]
        # the plane h = -1 has gone outwards there: the old point lies within it now
        assert normals[1] @ arm + offsets[1] > -1


@pytest.mark.parametrize("part", ["push", "tilt", "exponent"])
def test_handles_of_a_mirror_image_do_the_same_mirrored(part: Part) -> None:
    scene = edit.turn_shapes(edit.move_shapes(BLOCK, [0], (3, 0, 0)), [0], edit.about((0, 0, 1), 20), (3, 0, 0))
    scene = edit.put(scene, "mirror", ["x"])
    aim = Aim(Camera(distance=9.0, azimuth=0.0, elevation=20.0), (800, 600))  # the mirror's plane in the picture's middle
    own, other = (handles(scene, 0, 1, aim, image=image) for image in ((1.0, 1.0, 1.0), IMAGE))
    assert own is not None
    assert other is not None
    assert np.allclose(other.face.middle, own.face.middle * IMAGE)
    assert np.allclose(other.middle, (800 - own.middle[0], own.middle[1]))
    after = []
    for known, to_the_right in ((own, 1.0), (other, -1.0)):
        spot = known.arrow[1] if part == "push" else known.ring[np.argmin(known.ring[:, 1])]
        gesture = known.taken(part, scene, aim, (float(spot[0]), float(spot[1])), "one")
        after.append(held(gesture, 12.0 * to_the_right if part != "exponent" else 12.0, 30.0).scene)
    assert after[0] != scene
    for one, mirrored in zip(after[0].shapes[0].strips, after[1].shapes[0].strips, strict=True):
        for name in ("normal", "half_width", "offset", "gamma"):
            assert getattr(one, name) == pytest.approx(getattr(mirrored, name), abs=1e-9)


@pytest.mark.parametrize("kind", [Move, Turn, Scale])
def test_arranging_along_an_axis(kind: type[Move] | type[Turn] | type[Scale]) -> None:
    gesture = kind(BLOCK, AIM, (0,), (0.0, 0.0, 0.0), (450.0, 300.0)).locked("z")
    assert gesture.axis == "z"
    assert gesture.locked("z").axis == ""
    transform = held(gesture, typed="2").scene.shapes[0].transform
    assert transform.translation == ((0, 0, 2) if kind is Move else (0, 0, 0))
    assert edit.angles(transform.rotation) == pytest.approx((0, 0, 2 if kind is Turn else 0))
    assert transform.scale == ((1, 1, 2) if kind is Scale else (1, 1, 1))


def test_a_snapped_move_brings_the_origin_onto_the_grid() -> None:
    aim = replace(AIM, grid=0.25)
    two = edit.move_shapes(edit.add_shape(BLOCK, edit.new_shape("ball")), [1], (0.13, -0.07, 0.31))
    gesture = Move(two, aim, (0, 1), (0.0, 0.0, 0.0), (400.0, 300.0))
    after = held(gesture, 40.0, -25.0, snap=True).scene
    at, other = (np.array(after.shapes[index].transform.translation) for index in (1, 0))
    assert np.allclose(at / 0.25, np.round(at / 0.25), atol=1e-9)
    assert np.allclose(at - other, (0.13, -0.07, 0.31)), "the others keep their places beside it"
    assert np.max(np.abs(other - gesture.measured((40.0, -25.0)))) <= 0.125 + 1e-9
    locked = held(gesture.locked("x"), 100.0, 0.0, snap=True).scene.shapes[1].transform.translation
    assert locked[0] / 0.25 == pytest.approx(round(locked[0] / 0.25))
    assert locked[0] > 0.2
    assert locked[1:] == (-0.07, 0.31)
    assert held(gesture, 0.0, 0.0, snap=True).scene == two, "what is not moved stays"
    front = replace(gesture, aim=Aim(Camera(azimuth=90.0, elevation=0.0), aim.size, 0.25))
    assert held(front, 30.0, 30.0, snap=True).scene.shapes[1].transform.translation[0] == 0.13, "along the view nothing moves"


@pytest.mark.parametrize("way", ["one", "both", "slide"])
@pytest.mark.parametrize("mirrored", [False, True])
def test_a_snapped_push_brings_the_plane_onto_the_grid(way: Way, mirrored: bool) -> None:
    aim = replace(AIM, grid=0.2)
    scene = edit.turn_shapes(edit.move_shapes(BLOCK, [0], (0.93, 0.07, 0)), [0], edit.about((0, 0, 1), 20), (0.93, 0.07, 0))
    scene = edit.put(scene, "mirror", ["x"]) if mirrored else scene
    grip = Grip(0, 0, 1, (0.0, 0.0, 0.0), IMAGE if mirrored else (1.0, 1.0, 1.0))
    grip = replace(grip, point=tuple(grip.face(scene).middle))
    pushed = held(Push(scene, aim, grip, way), 80.0 if not mirrored else -80.0, 0.0, snap=True)
    face = grip.face(pushed.scene)
    distance = float(face.normal @ face.middle) / 0.2
    assert distance == pytest.approx(round(distance), abs=1e-9)
    assert pushed.values[0] > 0.2


def test_keys_need_a_selection_and_turn_about_its_middle() -> None:
    two = edit.move_shapes(edit.add_shape(BLOCK, edit.new_shape("ball")), [1], (2, 0, 0))
    assert reach.modal("turn", two, Selection(), AIM, (0, 0)) is None
    gesture = reach.modal("turn", two, Selection((0, 1)), AIM, (0, 0))
    assert isinstance(gesture, Turn)
    assert gesture.pivot == (1, 0, 0)
    after = held(gesture.locked("z"), typed="180").scene
    assert np.allclose([shape.transform.translation for shape in after.shapes], [(2, 0, 0), (0, 0, 0)])


def test_flat_scenes_are_pushed_at_their_lines() -> None:
    flat = Scene(shapes=(edit.new_shape("block", 2),), dimension=2)
    aim = Aim(Camera(elevation=90, azimuth=0), (800, 600))
    grip = grip_at(flat, (0.3, -1.0, 0.02))
    assert grip == Grip(0, 1, -1, (0.3, -1.0, 0.0))
    face = grip.face(flat)
    assert np.allclose(face.polygon[:, 1:], (-1, 0))
    assert np.ptp(face.polygon[:, 0]) == pytest.approx(2)
    moved = aim.pixel((0.3, -1.4, 0)) - aim.pixel((0.3, -1.0, 0))
    assert held(Push(flat, aim, grip), *moved).scene.shapes[0].strips[1].half_width == pytest.approx(1.2)
