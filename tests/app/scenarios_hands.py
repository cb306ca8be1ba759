"""The hands on the clay in the real window: press, drag and release where the picture says that something is."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui
from numpy.typing import ArrayLike

from hqmodel import edit
from hqmodel.app import editing
from hqmodel.app.intents import Do, Edit, Equip, Look, Select
from hqmodel.app.tools.aim import Aim
from hqmodel.app.tools.handles import handles
from hqmodel.app.tools.kit import TOOLS, Kit
from hqmodel.edit.frames import frame_of
from hqmodel.field import frame_residual, world_planes
from hqmodel.files.dump import dumps
from hqmodel.model import Camera, Scene

from .drive import Hands

Key = imgui.Key
LEFT = imgui.MouseButton_.left


def aim(hands: Hands) -> Aim:
    size = hands.ctx.get_window_by_ref("//Viewport").size
    return Aim(hands.session.view.camera, (int(size.x), int(size.y)))


def goto(hands: Hands, pixel: ArrayLike) -> None:
    """The mouse to a pixel of the viewport."""
    corner = hands.ctx.get_window_by_ref("//Viewport").pos
    x, y = np.asarray(pixel, dtype=float)
    hands.ctx.mouse_move_to_pos((corner.x + float(x), corner.y + float(y)))
    hands.settle()


def point_at(hands: Hands, point: ArrayLike) -> None:
    """The mouse to where a world point is seen."""
    goto(hands, aim(hands).pixel(point))


def drag(hands: Hands, *steps: ArrayLike, release: bool = True) -> None:
    """Press here, move by so many pixels at each step, and let go."""
    hands.ctx.mouse_down()
    hands.settle()
    for step in steps:
        move(hands, step)
    if release:
        hands.ctx.mouse_up()
        hands.settle()


def under(hands: Hands) -> int | None:
    """The strip under the pointer."""
    grip = hands.window.hand.grip(hands.session.scene)
    return None if grip is None else grip.strip


def section_and_legend(hands: Hands) -> None:
    """The section view cuts the picture, not the body; its plane slides; curvature has its legend."""
    session = hands.session
    scene = begin(hands, "ball")
    hands.menu("View/Section/###section z")
    assert session.view.cut is not None
    assert session.view.cut.offset == 0
    point_at(hands, (0, 0, 0))
    assert under(hands) is None, "the filled cut is no face to take hold of"
    hands.type_value("//Viewport/##section", 0.5)
    assert session.view.cut.offset == 0.5
    hands.menu("View/###mode curvature")
    hands.shoot("section")
    hands.click(f"//Viewport/{icons.ICON_FA_REPEAT}##other side")
    assert session.view.cut.normal == (0, 0, -1)
    hands.click(f"//Viewport/{icons.ICON_FA_XMARK}##no section")
    assert session.view.cut is None
    assert session.scene is scene
    assert not session.history.can_redo


def move(hands: Hands, by: ArrayLike) -> None:
    at, (x, y) = imgui.get_io().mouse_pos, np.asarray(by, dtype=float)
    hands.ctx.mouse_move_to_pos((at.x + float(x), at.y + float(y)))
    hands.settle()


def begin(hands: Hands, kind: str = "block") -> Scene:
    """One shape, seen from the front and a little from above."""
    scene = Scene(shapes=(edit.new_shape(kind),))
    hands.session.apply([Edit("begin", lambda _: scene), Look(Camera(distance=7.0, azimuth=25.0, elevation=25.0)), Select(None)])
    hands.settle()
    return scene


def planes(scene: Scene, strip: int, shape: int = 0) -> tuple[float, float]:
    """Where the planes h = 1 and h = -1 of a strip are along its normal."""
    normals, offsets = world_planes(scene.shapes[shape], scene.slice)
    length = float(np.linalg.norm(normals[strip]))
    return (1 - float(offsets[strip])) / length, (-1 - float(offsets[strip])) / length


def once(hands: Hands, label: str, before: Scene) -> None:
    """It was one undo step, which undo takes back to the last byte and redo does again."""
    session, text = hands.session, dumps(before)
    after = session.scene
    assert session.history.undo_label == label
    editing.undo(session)
    assert dumps(session.scene) == text
    editing.redo(session)
    assert session.scene == after
    assert after != before


def a_face_is_pushed(hands: Hands) -> None:
    """The plane under the pointer moves by what the hand moves, the opposite one stays; Tab, Shift, Ctrl, Esc and numbers."""
    session, before = hands.session, begin(hands)
    point_at(hands, (0.2, -1.0, 0.1))
    assert under(hands) == 1, "the front is the block's second strip"
    towards = aim(hands).pixel((0.2, -1.5, 0.1)) - aim(hands).pixel((0.2, -1.0, 0.1))
    drag(hands, towards / 2, towards / 2)
    near, far = planes(session.scene, 1)
    assert abs(near - 1.0) < 1e-9, "the plane at the back stays"
    assert abs(far + 1.5) < 0.08, far
    once(hands, "Push plane", before)
    editing.undo(session)

    point_at(hands, (0.2, -1.0, 0.1))
    drag(hands, (0, 6), (0, 20), release=False)
    hands.keys(Key.tab)
    near, far = planes(session.scene, 1)
    assert abs(near + far) < 1e-9, "both planes"
    hands.keys(Key.tab)
    near, far = planes(session.scene, 1)
    assert abs(near - far - 2) < 1e-9, "the strip slides"
    hands.keys(Key.escape)
    assert session.scene is before
    assert session.held is None
    hands.ctx.mouse_up()
    hands.settle()
    assert session.scene is before

    point_at(hands, (0.2, -1.0, 0.1))
    drag(hands, (0, 8), (0, 8), release=False)
    hands.ctx.key_chars("0.25")
    hands.settle()
    hands.keys(Key.enter)
    hands.ctx.mouse_up()
    hands.settle()
    assert abs(planes(session.scene, 1)[1] + 1.25) < 1e-9, "what is typed is what is had"
    once(hands, "Push plane", before)
    editing.undo(session)

    point_at(hands, (0.2, -1.0, 0.1))
    drag(hands, (0, 8), release=False)
    hands.ctx.key_down(Key.mod_ctrl)
    move(hands, (0, 23))
    step = aim(hands).step
    at = planes(session.scene, 1)[1]
    assert at < -1
    assert abs(at / step - round(at / step)) < 1e-6
    hands.ctx.key_up(Key.mod_ctrl)
    hands.keys(Key.escape)
    hands.ctx.mouse_up()
    hands.settle()


def handles_of_a_strip(hands: Hands) -> None:
    """A click selects the strip; its arrow pushes, its ring tilts, its diamond softens."""
    session, before = hands.session, begin(hands)
    point_at(hands, (0.5, -1.0, 0.4))
    hands.ctx.mouse_click()
    hands.settle()
    assert (session.selection.active, session.selection.strip) == (0, 1)

    known = handles(before, 0, 1, aim(hands))
    assert known is not None
    goto(hands, known.arrow[0] + 0.8 * (known.arrow[1] - known.arrow[0]))
    drag(hands, *[(known.arrow[1] - known.arrow[0]) / 4] * 3)
    assert planes(session.scene, 1)[1] < -1.1
    once(hands, "Push plane", before)
    editing.undo(session)
    hands.settle()

    top = int(np.argmin(known.ring[:, 1]))
    goto(hands, known.ring[top])
    drag(hands, (-4, 12), (-4, 12))
    normals, _ = world_planes(session.scene.shapes[0], 0.0)
    tilted = normals[1] / np.linalg.norm(normals[1])
    assert 0.05 < abs(tilted[2]) < 0.9
    assert abs(np.linalg.norm(normals[1]) - 1.0) < 1e-9, "as thick as before"
    once(hands, "Tilt plane", before)
    editing.undo(session)
    hands.settle()

    goto(hands, known.middle)
    drag(hands, (-30, 0), (-60, 0))
    assert session.scene.shapes[0].strips[1].gamma < 10
    assert session.scene.shapes[0].strips[0].gamma == 20
    once(hands, "Exponent", before)


def pat_and_chop(hands: Hands) -> None:
    """A pat adds one strip that follows the push; a line across the body cuts it."""
    session, before = hands.session, begin(hands, "ball")
    session.apply([Equip(Kit("pat"))])
    spot = np.array([-0.3, -0.6, np.sqrt(0.55)])
    point_at(hands, spot)
    drag(hands, *[(aim(hands).pixel(spot * 0.8) - aim(hands).pixel(spot)) / 2] * 2)
    assert len(session.scene.shapes[0].strips) == 4
    depth = 1 - planes(session.scene, 3)[0]
    assert 0.05 < depth < 0.4
    normals, _ = world_planes(session.scene.shapes[0], 0.0)
    assert normals[3] @ spot / np.linalg.norm(normals[3]) > 0.99, "tangent where it was pressed"
    once(hands, "Pat", before)
    editing.undo(session)

    session.apply([Equip(Kit("chop"))])
    goto(hands, aim(hands).pixel((0, 0, 0)) - (150, 50))
    drag(hands, (100, 0), (200, 0))
    normals, _ = world_planes(session.scene.shapes[0], 0.0)
    cut = normals[3] / np.linalg.norm(normals[3])
    assert cut[2] > 0.8, "the upper piece goes, as it is the smaller"
    assert 0 < planes(session.scene, 3)[0] < 1
    once(hands, "Chop", before)


def soften_and_wheel(hands: Hands) -> None:
    """Exponents by a drag, by the wheel with Ctrl held, and by the keys for rounder and sharper."""
    session, before = hands.session, begin(hands)
    session.apply([Equip(Kit("soften"))])
    point_at(hands, (0.2, -1.0, 0.1))
    drag(hands, (-20, 0), (-40, 0))
    assert [strip.gamma == 20 for strip in session.scene.shapes[0].strips] == [True, False, True]
    once(hands, "Exponent", before)
    editing.undo(session)

    session.apply([Equip(Kit("faces"))])
    point_at(hands, (0.2, -1.0, 0.1))
    distance = session.view.camera.distance
    hands.ctx.key_down(Key.mod_ctrl)
    hands.ctx.mouse_wheel_y(-4)
    hands.settle()
    hands.ctx.key_up(Key.mod_ctrl)
    hands.settle()
    assert session.scene.shapes[0].strips[1].gamma < 20
    assert session.view.camera.distance == distance
    once(hands, "Exponent", before)
    editing.undo(session)

    session.apply([Select(0)])
    hands.keys(Key.left_bracket)
    assert {strip.gamma for strip in session.scene.shapes[0].strips} == {16.0}
    hands.keys(Key.right_bracket)
    assert {strip.gamma for strip in session.scene.shapes[0].strips} == {20.0}


def grab_turn_scale(hands: Hands) -> None:
    """G, R and S with the pointer, with axes and numbers; a click takes it, Esc and the right button put it back."""
    session, before = hands.session, begin(hands)
    session.apply([Select(0)])
    goto(hands, aim(hands).pixel((0.6, 0, 0)))
    hands.keys(Key.g)
    assert session.held is not None
    hands.keys(Key.x)
    move(hands, aim(hands).pixel((0.5, 0, 0)) - aim(hands).pixel((0, 0, 0)))
    x, y, z = session.scene.shapes[0].transform.translation
    assert abs(x - 0.5) < 0.05
    assert (y, z) == (0, 0)
    hands.ctx.mouse_click()
    hands.settle()
    assert session.held is None
    once(hands, "Move", before)
    editing.undo(session)

    hands.keys(Key.r)
    hands.keys(Key.z)
    hands.ctx.key_chars("30")
    hands.settle()
    hands.keys(Key.enter)
    assert np.allclose(edit.angles(session.scene.shapes[0].transform.rotation), (0, 0, 30))
    once(hands, "Turn", before)
    editing.undo(session)

    hands.keys(Key.s)
    hands.ctx.key_chars("2")
    hands.settle()
    hands.keys(Key.enter)
    assert session.scene.shapes[0].transform.scale == (2, 2, 2)
    once(hands, "Scale", before)
    editing.undo(session)

    hands.keys(Key.g)
    move(hands, (80, 0))
    assert session.scene != before
    hands.ctx.mouse_click(imgui.MouseButton_.right)
    hands.settle()
    assert session.scene is before
    assert session.held is None


def gizmo_and_cube(hands: Hands) -> None:
    """ImGuizmo's arrows move the selected shape in one step; the cube turns the view."""
    session, before = hands.session, begin(hands)
    session.apply([Select(0), Equip(Kit("move"))])
    hands.settle(3)
    along = aim(hands).pixel((0, 0, 1)) - aim(hands).pixel((0, 0, 0))
    along /= np.hypot(*along)
    goto(hands, aim(hands).pixel((0, 0, 0)) + 45 * along)
    drag(hands, *[10 * along] * 4)
    x, y, z = session.scene.shapes[0].transform.translation
    assert z > 0.2
    assert max(abs(x), abs(y)) < 1e-5
    once(hands, "Move", before)
    goto(hands, aim(hands).pixel((0, 0, z)) + 45 * along)
    hands.keys(Key._1)
    hands.ctx.mouse_click()
    hands.settle()
    assert session.selection.strip == 1, "where its arrow was the mouse is the next tool's"
    session.apply([Select(0), Equip(Kit("move"))])
    hands.settle()
    camera = session.view.camera
    size = aim(hands).size
    em = imgui.get_font_size()
    goto(hands, (size[0] - 3 * em, 3 * em))
    drag(hands, (25, 0), (25, 0))
    hands.settle(5)
    assert session.view.camera.azimuth != camera.azimuth
    assert session.view.camera.target == camera.target


def boxes_and_tools(hands: Hands) -> None:
    """A box selects what is in it; each tool has its key and its button; solo, carving, copies around."""
    session = hands.session
    begin(hands, "ball")
    session.apply([Do("add block"), Edit("aside", lambda scene: edit.move_shapes(scene, [1], (1.6, 0, 0))), Select(None)])
    hands.settle()
    hands.keys(Key.b)
    assert session.kit.tool == "box"
    goto(hands, aim(hands).pixel((1.6, 0, 0)) - (40, 40))
    drag(hands, (40, 40), (40, 40))
    assert session.selection.shapes == (1,)
    for name, tool in TOOLS.items():
        hands.click(f"//Viewport/{tool.icon}###tool {name}")
        assert session.kit.tool == name
    for key, name in ((Key._1, "faces"), (Key._2, "pat"), (Key._3, "chop"), (Key._4, "soften")):
        hands.keys(key)
        assert session.kit.tool == name
    hands.keys(Key.keypad_divide)
    assert [shape.visible for shape in session.scene.shapes] == [False, True]
    hands.keys(Key.keypad_divide)
    assert [shape.visible for shape in session.scene.shapes] == [True, True]
    hands.menu("Shape/###carve")
    assert session.scene.shapes[1].coefficient == -1
    hands.menu("Shape/Copies Around z/###around 4")
    assert len(session.scene.shapes) == 5
    hands.keys(Key.a)
    assert len(session.selection.shapes) == 5


def pulled_out_of_the_body(hands: Hands) -> None:
    """A face dragged out of the body is gone, strip and all."""
    session, before = hands.session, begin(hands, "ball")
    session.apply([Edit("pat", lambda scene: edit.pat(scene, 0, (0, -1, 0), (0, -1, 0), 0.3)), Select(0)])
    patted = session.scene
    hands.settle()
    point_at(hands, (0.0, -0.7, 0.0))
    assert under(hands) == 3
    towards = aim(hands).pixel((0, -1.9, 0)) - aim(hands).pixel((0, -0.7, 0))
    drag(hands, towards / 2, towards / 2)
    assert session.scene.shapes == before.shapes
    once(hands, "Push plane", patted)


def a_frame_is_turned(hands: Hands) -> None:
    """The shape's frame: replaced by a ready-made one, turned in four-space in one step, made orthonormal again."""
    session = hands.session
    begin(hands, "ball")
    session.apply([Select(0)])
    hands.settle()
    hands.click("//Properties/Frame in four-space")
    hands.click("//Properties/##start")
    hands.click("//$FOCUSED/tetrahedron")
    assert len(session.scene.shapes[0].strips) == 4
    framed = session.scene
    hands.drag("//Properties/##turn xt", 40)
    rows = frame_of(session.scene, 0)
    assert not np.allclose(rows, frame_of(framed, 0))
    assert frame_residual(rows) < 1e-12, "turned, it is as orthonormal as before"
    once(hands, "Turn frame", framed)
    session.apply([Edit("spoil", lambda scene: edit.put(scene, "shapes[0].strips[1].normal", (1, 0.2, 0)))])
    hands.settle()
    hands.click("//Properties/Make Orthonormal")
    assert frame_residual(frame_of(session.scene, 0)) < 1e-12


def first_session(hands: Hands) -> None:
    """From launch to a patted, blended, exported shape in under 15 actions."""
    session = hands.session
    hands.settle()
    spot = np.array([0.5, -0.7, 0.5]) / np.sqrt(0.99)

    def pat() -> None:
        point_at(hands, spot)
        drag(hands, (0, 15), (0, 15))

    def typed(text: str) -> None:
        hands.ctx.key_chars(text)
        hands.settle()
        hands.keys(Key.enter)

    actions: list[Callable[[], None]] = [
        lambda: hands.keys(Key._2),
        pat,
        lambda: hands.menu("Add/###add block"),
        lambda: hands.keys(Key.g),
        lambda: hands.keys(Key.x),
        lambda: typed("1.2"),
        lambda: hands.keys(Key.h),
        lambda: typed("3"),
        lambda: hands.keys(Key.mod_ctrl | Key.e),
        lambda: hands.type_value("//Export/##resolution", 48),
        lambda: hands.type_value("//Export/##file", str(hands.folder / "first.glb")),
        lambda: hands.click("//Export/Export"),
    ]
    for action in actions:
        action()
    hands.wait(lambda: session.job is None and bool(session.dialogs))
    assert [len(shape.strips) for shape in session.scene.shapes] == [4, 3]
    assert session.scene.shapes[1].hardness == 3
    assert session.scene.shapes[1].transform.translation == (1.2, 0, 0)
    assert (hands.folder / "first.glb").stat().st_size > 10_000
    assert len(actions) < 15
