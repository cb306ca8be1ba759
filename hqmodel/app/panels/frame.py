"""The shape as a slice through a higher-dimensional one (eqs. 16-22, 38, 41): its frame put right, turned, replaced."""

from __future__ import annotations

from functools import partial
from math import radians

from imgui_bundle import imgui

from hqmodel import edit
from hqmodel.edit.frames import STARTS, frame_of, framed_scene, make_orthonormal, turn_frame
from hqmodel.field import frame_residual
from hqmodel.model import Scene

from ..form import Form
from ..intents import Edit, Grab, Show

# The planes of four-space, and what a turn in each does.
_PLANES = {
    **dict.fromkeys(("xy", "xz", "yz"), "Turns the shape's strips as a body turns."),
    **dict.fromkeys(("xt", "yt", "zt"), "Tips the slice over: t trades places with an axis, and another section shows."),
}
# Nearer to an orthonormal one than this, a frame counts as one; degrees that a pixel turns by.
_EXACT, _RATE = 1e-9, 0.5


def draw(form: Form, index: int) -> None:
    """How far the frame is from orthonormal, what mends that, turns in the six planes, and other frames to begin from."""
    rows = frame_of(form.scene, index)
    residual = frame_residual(rows)
    form.label("Frame", "The strips' normals and slice rates as four columns; orthonormal ones cut a hypercube or hypersphere.")
    imgui.text_unformatted("orthonormal" if residual < _EXACT else f"off orthonormal by {residual:.2g}")
    imgui.begin_disabled(residual < _EXACT or len(rows) < 4)
    if imgui.button("Make Orthonormal"):
        form.intents.append(Edit("Make orthonormal", partial(make_orthonormal, shape=index)))
    imgui.end_disabled()
    imgui.same_line()
    imgui.set_next_item_width(-1)
    if imgui.begin_combo("##start", "Replace by..."):
        for name in STARTS:
            if imgui.selectable(name, False)[0]:
                form.intents.append(Edit("Replace frame", partial(_replaced, index=index, name=name)))
        imgui.end_combo()
    _turns(form, index)


def _turns(form: Form, index: int) -> None:
    """A control for each plane, to be dragged sideways."""
    form.label("Turn", "Drag sideways to turn the frame in a plane of four-space, or type degrees after Ctrl+click.")
    width = (imgui.get_content_region_avail().x - 2 * imgui.get_style().item_inner_spacing.x) / 3
    for number, (plane, help) in enumerate(_PLANES.items()):
        if number % 3:
            imgui.same_line(0, imgui.get_style().item_inner_spacing.x)
        elif number:
            form.label("")
        imgui.set_next_item_width(width)
        before, angle = form.memory.turns.get(plane, (form.scene, 0.0))
        changed, angle = imgui.drag_float(f"##turn {plane}", angle, _RATE, -360.0, 360.0, f"{plane}  %.1f°")
        imgui.set_item_tooltip(help)
        if imgui.is_item_activated():
            form.intents.append(Grab(("shapes", index, "frame", plane), "Turn frame"))
            before = form.scene
        if imgui.is_item_active() or changed:
            form.memory.turns[plane] = before, angle
        if changed:
            form.intents.append(Show(turn_frame(before, index, plane, radians(angle))))
        if not imgui.is_item_active():
            form.memory.turns.pop(plane, None)


def _replaced(scene: Scene, index: int, name: str) -> Scene:
    """The shape with the strips of a ready-made frame, and the slice where that is what it is called."""
    start = framed_scene(name)
    return edit.put(edit.put_fields(scene, ("shapes", index), strips=start.shapes[0].strips, groups={}), "slice", start.slice)
