"""What is done in the real window, through ImGui's test engine. Each function is one visit, in a process of its own."""

from __future__ import annotations

import ctypes
import json
import os
from pathlib import Path
from typing import Any, cast

import glfw
import trimesh
from imgui_bundle import imgui

from hqmodel import files
from hqmodel.app import editing, native
from hqmodel.app.actions import HIDDEN
from hqmodel.app.asks import Exported, Problem, Unsaved
from hqmodel.app.intents import Do, Intent, Put, Select
from hqmodel.app.panels import status
from hqmodel.edit import get, parse
from hqmodel.model import Shape

from .drive import Hands

Key = imgui.Key
CTRL, SHIFT = Key.mod_ctrl, Key.mod_shift
PROPERTIES = "//Properties/**/"
OUTLINER = "//Outliner/**/"
SCENE = "//Scene/**/"


def first_shape(hands: Hands) -> Shape:
    return hands.session.scene.shapes[0]


def title(hands: Hands) -> str:
    return str(glfw.get_window_title(hands.window.window))


def choose(hands: Hands, dialog: str, path: Path, verb: str) -> None:
    """Type a path into our own file dialog, and take it."""
    hands.type_value(f"//{dialog}/##folder", str(path))
    hands.click(f"//{dialog}/{verb}")


def change_save_reopen_export(hands: Hands) -> None:
    """The main job: an exponent by its slider, undo, redo, save, reopen, export."""
    exponent = f"{PROPERTIES}##shapes[0].strips[0].gamma"
    before = first_shape(hands).strips[0].gamma
    hands.drag(exponent, 30)
    dragged = first_shape(hands).strips[0].gamma
    assert dragged > before
    assert hands.session.history.labels == ["Exponent"]
    assert title(hands) == "Untitled* - hqmodel"
    hands.keys(CTRL | Key.z)
    assert first_shape(hands).strips[0].gamma == before
    assert title(hands) == "Untitled - hqmodel"
    hands.keys(CTRL | SHIFT | Key.z)
    assert first_shape(hands).strips[0].gamma == dragged
    hands.keys(CTRL | Key.z)
    hands.keys(CTRL | Key.y)
    assert first_shape(hands).strips[0].gamma == dragged

    path = hands.folder / "clay.json"
    hands.keys(CTRL | Key.s)
    choose(hands, "Save As", path, "Save")
    assert title(hands) == "clay - hqmodel"
    shown = hands.session.scene
    assert files.load(path).changed(view={}) == shown
    assert json.loads(path.read_text())["shapes"][0]["strips"][0]["gamma"] == dragged

    hands.keys(CTRL | Key.n)
    assert first_shape(hands).strips[0].gamma == before
    hands.keys(CTRL | Key.o)
    choose(hands, "Open", path, "Open")
    assert hands.session.scene.changed(view={}) == shown
    assert title(hands) == "clay - hqmodel"

    hands.keys(CTRL | Key.e)
    hands.click("//Export/##Format")
    hands.click("//$FOCUSED/Wavefront OBJ")
    hands.type_value("//Export/##resolution", 32)
    hands.click("//Export/##reduced")
    hands.type_value("//Export/##target faces", 1500)
    hands.click("//Export/Export")
    hands.wait(lambda: hands.session.job is None and bool(hands.session.dialogs))
    told = hands.session.dialogs[-1]
    assert isinstance(told, Exported), told
    body = trimesh.load_mesh(hands.folder / "clay.obj")
    assert body.is_watertight
    assert len(body.faces) == told.report["faces"]
    assert 1400 < len(body.faces) <= 1500
    hands.click("//Exported/OK")
    assert not hands.session.dialogs


def an_export_can_be_stopped(hands: Hands) -> None:
    """Progress is shown and Stop stops; meanwhile the panels go on working."""
    session = hands.session
    hands.menu("File/###export")
    hands.type_value("//Export/##resolution", 1024)
    hands.type_value("//Export/##file", str(hands.folder / "large.ply"))
    hands.click("//Export/Export")
    assert session.job is not None
    hands.drag(f"{PROPERTIES}##shapes[0].strips[0].gamma", 30)
    assert session.history.labels == ["Exponent"]
    assert not session.dialogs
    hands.click("//StatusBar/Stop")
    hands.wait(lambda: session.job is None)
    assert session.message == "Export cancelled; nothing was written"
    assert [path for path in hands.folder.iterdir() if "large" in path.name] == []


def flat_and_solid(hands: Hands) -> None:
    """The outline of a shape, and back; the box is named when the body has no end."""
    session = hands.session
    hands.ctx.window_focus("//Scene")
    hands.settle()
    for label, dimension, strips in (("Flat", 2, 2), ("Solid", 3, 3)):
        hands.click(f"{SCENE}{label}##dimension")
        assert (session.scene.dimension, len(session.scene.shapes[0].strips)) == (dimension, strips)
    assert status.notice(session) == ""
    session.apply([Put(("shapes", 0, "strips", 2, "sign"), -1, "Sign")])
    hands.settle()
    assert status.notice(session).startswith("Endless, shown cut by the box (")
    session.apply([Put(("shapes", 0, "visible"), False, "Hide")])
    hands.settle()
    assert status.notice(session) == "Nothing to see: the body is empty"


def the_systems_own_dialogs(hands: Hands) -> None:
    """Where the system has file dialogs, they are used; this one is a stand-in that answers at once."""
    session, answer = hands.session, hands.folder / "answer"
    stand_in = hands.folder / "bin" / "zenity"
    stand_in.parent.mkdir()
    stand_in.write_text(f"#!/bin/sh\ncat {answer}\n")
    stand_in.chmod(0o755)
    os.environ["PATH"] = f"{stand_in.parent}{os.pathsep}{os.environ['PATH']}"
    assert native.available()
    hands.window.chooser = native.NativeChooser()
    hands.drag(f"{PROPERTIES}##shapes[0].strips[0].gamma", 30)
    answer.write_text(f"{hands.folder / 'native'}\n")
    hands.keys(CTRL | Key.s)
    hands.wait(lambda: not session.dialogs)
    assert files.load(hands.folder / "native.json").changed(view={}) == session.scene
    answer.write_text("")
    hands.keys(CTRL | Key.o)
    hands.wait(lambda: not session.dialogs)
    assert title(hands) == "native - hqmodel"
    answer.write_text(f"{hands.folder / 'native.json'}\n")
    hands.keys(CTRL | Key.o)
    hands.wait(lambda: not session.dialogs and not session.history.can_undo)
    assert title(hands) == "native - hqmodel"


def every_field_has_a_control(hands: Hands) -> None:
    """Each field of the table is set by typing into its slider, and the scene has it."""
    hands.session.apply([Do("add cylinder")])
    values = {
        "shapes[1].strips[2].gamma": 7.5,
        "shapes[1].strips[2].half_width": 0.75,
        "shapes[1].coefficient": -0.5,
        "shapes[1].hardness": 3.5,
        "shapes[1].constant": 0.5,
        "shapes[1].transform.translation[2]": 12.5,
        "shapes[1].transform.scale[0]": 2.5,
        "shapes[1].groups.side.gamma": 9.0,
    }
    typed(hands, PROPERTIES, values)
    hands.session.apply([Select(1, 2)])
    hands.settle()
    strip = {"offset": 0.25, "slice": -0.5, "normal[0]": 0.5, "gamma": 3.0, "half_width": 1.5}
    typed(hands, PROPERTIES, {f"shapes[1].strips[2].{name}": value for name, value in strip.items()})
    hands.click(f"{PROPERTIES}Hyperbolic (-)##shapes[1].strips[2].sign")
    assert get(hands.session.scene, "shapes[1].strips[2].sign") == -1
    bar = next(window.name for window in imgui.get_current_context().windows if window.name.startswith("##Bottom"))
    typed(hands, f"//{bar}/", {"slice": 0.25})
    hands.ctx.window_focus("//Scene")
    hands.settle()
    typed(hands, SCENE, {"level": 0.75, "shapes[0].coefficient": 2.0, "shapes[0].hardness": 5.0})
    hands.click(f"{SCENE}##bounds")
    assert hands.session.scene.bounds is not None
    typed(hands, SCENE, {"bounds[1][2]": 6.0})
    for name in ("name", "author", "license"):
        hands.type_value(f"{SCENE}##{name}", f"my {name}")
        assert get(hands.session.scene, name) == f"my {name}"


def typed(hands: Hands, panel: str, values: dict[str, float]) -> None:
    """Type each value into its slider; each is one step."""
    for path, value in values.items():
        steps = len(hands.session.history.labels)
        hands.type_value(f"{panel}##{path}", value)
        assert get(hands.session.scene, parse(path)) == value, path
        assert len(hands.session.history.labels) == steps + 1, path


def turns_and_resets(hands: Hands) -> None:
    """Rotation in degrees; a double click and the menu reset; what is not permitted is not done."""
    hands.type_value(f"{PROPERTIES}##shapes[0].transform.rotation.z", 90.0)
    x, y, z, w = first_shape(hands).transform.rotation
    assert abs(z - 0.5**0.5) < 1e-12
    assert abs(w - 0.5**0.5) < 1e-12
    assert (x, y) == (0, 0)
    slider = f"{PROPERTIES}##shapes[0].hardness"
    hands.drag(slider, 40)
    kept = first_shape(hands).hardness
    hands.ctx.item_double_click(slider)
    hands.settle()
    assert first_shape(hands).hardness == 1.0
    hands.keys(CTRL | Key.z)
    assert first_shape(hands).hardness == kept
    hands.ctx.item_click(slider, imgui.MouseButton_.right)
    hands.click("//$FOCUSED/Reset")
    assert first_shape(hands).hardness == 1.0
    hands.type_value(slider, -4.0)
    assert first_shape(hands).hardness == 1.0
    assert hands.session.failed
    hands.click(f"{PROPERTIES}y##mirror")
    hands.click(f"{PROPERTIES}x##mirror")
    assert first_shape(hands).mirror == ("x", "y")


def nothing_is_lost(hands: Hands) -> None:
    """Unsaved work: New, a drop and the close button all ask; a damaged file changes nothing."""
    session, path = hands.session, hands.folder / "dropped.json"
    files.save(session.scene.changed(name="Dropped"), path)
    hands.drag(f"{PROPERTIES}##shapes[0].strips[1].half_width", -30)
    work = session.scene

    hands.keys(CTRL | Key.n)
    assert isinstance(session.dialogs[-1], Unsaved)
    hands.keys(CTRL | Key.z)
    assert session.scene is work, "shortcuts wait while a dialog is open"
    hands.click("//Unsaved Changes/Cancel")

    glfw.set_window_should_close(hands.window.window, True)
    hands.wait(lambda: bool(session.dialogs))
    assert isinstance(session.dialogs[-1], Unsaved)
    assert not session.finished
    hands.keys(Key.escape)
    assert not session.dialogs
    assert session.scene is work

    damaged = hands.folder / "damaged.json"
    damaged.write_text('{"format": "hqmodel", "version": 1, "shapes": [{"strips": [{"normal": [0, 0, 0]}]}]}')
    drop(hands, damaged)
    hands.click("//Unsaved Changes/Don't Save")
    assert isinstance(session.dialogs[-1], Problem)
    assert session.dialogs[-1].lines == (
        f"{damaged}: shapes[0].strips[0].normal: expected a normal that is not zero, got [0.0, 0.0, 0.0]",
    )
    hands.click("//Not opened/OK")
    assert session.scene is work

    drop(hands, path)
    hands.click("//Unsaved Changes/Save")
    choose(hands, "Save As", hands.folder / "kept.json", "Save")
    assert session.scene.name == "Dropped"
    assert files.load(hands.folder / "kept.json").changed(view={}) == work
    assert title(hands) == "dropped - hqmodel"

    hands.keys(CTRL | Key.e)
    hands.keys(Key.escape)
    hands.menu("File/###save as")
    choose(hands, "Save As", hands.folder / "kept.json", "Save")
    hands.click("//Save As/Replace")
    assert files.load(hands.folder / "kept.json").name == "Dropped"


def drop(hands: Hands, path: Path) -> None:
    """What glfw does when a file is dropped: call the callback that is registered with it."""
    window, set_callback = hands.window.window, cast(Any, glfw.set_drop_callback)  # its stub has the C signature
    registered = set_callback(window, None)
    registered(window, 1, (ctypes.c_char_p * 1)(str(path).encode()))
    set_callback(window, hands.window.dropped)
    hands.wait(lambda: bool(hands.session.dialogs))


def the_outliner(hands: Hands) -> None:
    """Shapes and strips: add, name, hide, put in order, delete."""
    session = hands.session

    def names() -> list[str]:
        return [shape.name for shape in session.scene.shapes]

    hands.click("//Outliner/###add")
    hands.click("//$FOCUSED/Block")
    hands.menu("Add/###add cylinder")
    assert names() == ["Ball", "Block", "Cylinder"]
    hands.ctx.item_double_click(f"{OUTLINER}shape 1/###name")
    hands.settle()
    hands.ctx.key_chars_replace_enter("Brick")
    hands.settle()
    assert names() == ["Ball", "Brick", "Cylinder"]
    hands.click(f"{OUTLINER}shape 2/###eye")
    assert not session.scene.shapes[2].visible
    hands.ctx.item_drag_and_drop(f"{OUTLINER}shape 2/###name", f"{OUTLINER}shape 0/###name")
    hands.settle()
    assert names() == ["Cylinder", "Ball", "Brick"]
    hands.click(f"{OUTLINER}shape 0/###name")
    hands.keys(CTRL | Key.down_arrow)
    assert names() == ["Ball", "Cylinder", "Brick"]
    hands.keys(CTRL | Key.d)
    assert names() == ["Ball", "Cylinder", "Cylinder 2", "Brick"]
    hands.keys(Key.delete)
    hands.click(f"{OUTLINER}shape 2/###name")
    hands.keys(Key.x)
    assert names() == ["Ball", "Cylinder"]
    hands.click(f"{OUTLINER}shape 0/open")
    hands.click(f"{OUTLINER}strip 0 1/###name")
    assert (session.selection.active, session.selection.strip) == (0, 1)
    hands.keys(Key.x)
    assert len(session.scene.shapes[0].strips) == 2
    hands.click(f"{OUTLINER}shape 0/###name")
    hands.menu("Add/###add strip")
    assert len(session.scene.shapes[0].strips) == 3
    hands.click(f"{OUTLINER}shape 0/###name")
    hands.type_value(f"{PROPERTIES}##shapes[0].name", "x marks the spot")
    assert names() == ["x marks the spot", "Cylinder"], "X is a letter while a name is typed"
    while session.history.can_undo:
        editing.undo(hands.session)
    assert names() == ["Ball"]


def several_at_once(hands: Hands) -> None:
    """Several shapes get a name and a colour together, each in one step."""
    session = hands.session

    def names() -> list[str]:
        return [shape.name for shape in session.scene.shapes]

    session.apply([Do("add block"), Do("add cylinder"), Do("select all")])
    before, steps = session.scene, len(session.history.labels)
    hands.settle()
    hands.type_value(f"{PROPERTIES}several/##name", "Leg")
    assert names() == ["Leg 1", "Leg 2", "Leg 3"]
    hands.type_value(f"{PROPERTIES}several/##shapes[2].color/##X", 0.25)
    assert [shape.color[0] for shape in session.scene.shapes] == [0.25] * 3
    assert session.history.labels[steps:] == ["Rename", "Colour"]
    hands.shoot("several")
    hands.ctx.item_click(f"{OUTLINER}shape 1/###name", imgui.MouseButton_.right)
    hands.click("//$FOCUSED/Rename")
    hands.ctx.key_chars_replace_enter("Foot")
    hands.settle()
    assert names() == ["Foot 1", "Foot 2", "Foot 3"]
    for _ in range(3):
        hands.keys(CTRL | Key.z)
    assert session.scene == before


def the_viewport(hands: Hands) -> None:
    """Orbit, pan, zoom, standard views, framing, and a click that selects."""
    session, ctx = hands.session, hands.ctx
    session.apply([Do("add block"), Select(None)])
    hands.settle()
    start = session.view.camera
    ctx.mouse_move("//Viewport/view")
    ctx.mouse_drag_with_delta((60, 20), imgui.MouseButton_.middle)
    hands.settle()
    orbited = session.view.camera
    assert orbited.azimuth != start.azimuth
    assert orbited.target == start.target
    ctx.mouse_move_to_pos((270, 480))  # beside the body
    ctx.mouse_drag_with_delta((-40, 10), imgui.MouseButton_.left)
    hands.settle()
    assert session.view.camera.azimuth != orbited.azimuth
    assert session.selection.active is None, "a drag is no click"
    ctx.mouse_move("//Viewport/view")
    ctx.mouse_drag_with_delta((40, 10), imgui.MouseButton_.right)
    hands.settle()
    assert session.view.camera.target != start.target
    ctx.mouse_move("//Viewport/view")
    ctx.mouse_wheel_y(3)
    hands.settle()
    assert session.view.camera.distance < start.distance
    hands.keys(Key.home)
    for key, angles in ((Key.keypad1, (0, 0)), (Key.keypad3, (90, 0)), (Key.keypad7, (0, 90))):
        hands.keys(key)
        assert (session.view.camera.azimuth, session.view.camera.elevation) == angles
    hands.keys(Key.keypad5)
    assert session.view.camera.orthographic
    ctx.mouse_move("//Viewport/view")
    ctx.mouse_click()
    hands.settle()
    assert session.selection.active is not None
    ctx.mouse_move_to_pos((270, 480))
    ctx.mouse_click()
    hands.settle()
    assert session.selection.active is None
    hands.menu("View/###mode normals")
    assert session.view.mode == "normals"
    assert not session.history.dirty or session.history.labels == ["Add block"], "looking is no change"


def a_fault_in_a_panel(hands: Hands) -> None:
    """A panel that fails is told of and rests; all others go on, the work is there, and the panel comes back."""
    session, window = hands.session, hands.window
    hands.drag(f"{PROPERTIES}##shapes[0].hardness", 40)
    work, draw = session.scene, window.panels["Scene"]

    def failing() -> list[Intent]:
        imgui.begin_table("left open", 2)
        raise ZeroDivisionError("a fault of ours")

    window.panels["Scene"] = failing
    hands.ctx.window_focus("//Scene")
    hands.wait(lambda: bool(session.dialogs))
    problem = session.dialogs[-1]
    assert isinstance(problem, Problem)
    assert problem.lines[0] == "Scene: ZeroDivisionError: a fault of ours"
    copy = Path(problem.lines[-1].removeprefix("To be sure, a copy was saved as "))
    assert files.load(copy).changed(view={}) == work
    hands.click("//Something went wrong/OK")
    assert session.scene is work
    hands.keys(CTRL | Key.z)
    assert session.scene is not work
    window.panels["Scene"] = draw
    hands.click("//Scene/Try again##Scene")
    hands.type_value(f"{SCENE}##level", 0.5)
    assert session.scene.level == 0.5


def panels_and_themes(hands: Hands) -> None:
    """Panels can be closed and come back; the light theme is kept for the next time."""
    session = hands.session
    assert session.hidden_panels == {"Presets", *HIDDEN}
    hands.menu("View/Panels/###panel Presets")
    hands.settle(5)
    assert shown(hands, "Presets")
    hands.menu("View/Panels/###panel Presets")
    hands.settle(5)
    assert not shown(hands, "Presets")
    hands.menu("View/Theme/###theme light")
    assert files.Settings.read().preferences["theme"] == "light"
    hands.ctx.window_close("//Scene")
    hands.settle(3)
    assert session.hidden_panels == {"Presets", "Scene", *HIDDEN}
    hands.menu("View/Panels/###reset layout")
    hands.settle(5)
    assert session.hidden_panels == set(HIDDEN)
    assert shown(hands, "Scene")
    assert shown(hands, "Presets")
    for keys, dialog in ((Key.f1, "Shortcuts"), (None, "About hqmodel")):
        if keys is None:
            hands.menu("Help/###about")
        else:
            hands.keys(keys)
        hands.click(f"//{dialog}/Close")
        assert not session.dialogs


def shown(hands: Hands, panel: str) -> bool:
    window = hands.ctx.get_window_by_ref(f"//{panel}")
    return window is not None and window.was_active


def a_built_in_preset(hands: Hands) -> None:
    """A click in the Presets panel opens it; it has a picture; saving asks for a file."""
    session = hands.session
    preset = next(preset for preset in files.builtin() if preset.collection == "starters")
    hands.menu("View/Panels/###panel Presets")
    hands.settle(5)
    hands.ctx.window_focus("//Presets")
    hands.click(f"//Presets/**/##{preset.name}")
    assert session.scene == files.load(preset.path)
    assert session.document.path is None
    hands.type_value("//Presets/##search", "no preset is called this")
    assert not hands.ctx.item_exists(f"//Presets/**/##{preset.name}")
    hands.type_value("//Presets/##search", preset.title)
    hands.wait(lambda: hands.window.thumbnails.texture(preset.path) is not None)
    assert list((hands.folder / "cache").rglob("*.png")), "it is there at the next start"
    hands.ctx.mouse_move(f"//Presets/**/##{preset.name}")
    hands.settle()
    hands.click(f"//Presets/**/###star {preset.name}")
    assert files.Settings.read().preferences["favourites"] == [str(preset.path)]
    hands.settle()
    hands.click("//Presets/**/Favourites/###star " + preset.name)
    assert files.Settings.read().preferences["favourites"] == []
