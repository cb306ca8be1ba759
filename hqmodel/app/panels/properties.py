"""The properties of what is selected: a shape and how it blends, or one of its strips."""

from __future__ import annotations

from functools import partial

from imgui_bundle import imgui

from hqmodel import edit
from hqmodel.model import FIELDS, Shape, Strip

from ..form import Form, Memory
from ..intents import Do, Edit, Grab, Intent, Put, Select, Show
from ..session import Session
from . import frame
from .naming import shape_name, shared_name, strip_label, strip_name

_SIGNS = {"Closed (+)": 1, "Hyperbolic (-)": -1}
_ALONE = "No group"


def draw(session: Session, memory: Memory) -> list[Intent]:
    """Everything that can be set of the active shape, or of the strip that is selected in it."""
    index = session.selection.active
    if index is None:
        imgui.text_wrapped("Select a shape, in the Outliner or by a click on it.")
        return []
    form = Form(session.scene, memory)
    shape = session.scene.shapes[index]
    if session.selection.strip is None:
        if len(session.selection.shapes) > 1:
            _several(form, session.selection.shapes)
            imgui.separator_text(shape_name(shape, index))
        _shape(form, index, shape)
    else:
        _strip(form, index, session.selection.strip, shape)
    return form.intents


def _several(form: Form, indices: tuple[int, ...]) -> None:
    """What can be set of all selected shapes at once."""
    imgui.push_id("several")
    imgui.text_disabled(f"All {len(indices)} selected")
    form.label("Name", "Each is called by it, with a number.")
    imgui.set_next_item_width(-1)
    name = shared_name(form.scene.shapes[index] for index in indices)
    changed, name = imgui.input_text_with_hint("##name", "varied", name)
    if imgui.is_item_activated():
        form.intents.append(Grab(("shapes", "name"), "Rename"))
    if changed:
        form.intents.append(Show(edit.rename_shapes(form.scene, indices, name)))
    form.color(*[("shapes", index, "color") for index in reversed(indices)])
    imgui.pop_id()


def _shape(form: Form, index: int, shape: Shape) -> None:
    at = ("shapes", index)
    form.text((*at, "name"), "Name")
    form.color((*at, "color"))
    form.toggle((*at, "visible"), "Visible")
    if heading("Strips"):
        _strips(form, index, shape)
    if heading("Blend"):
        for name in ("coefficient", "hardness", "constant"):
            form.number((*at, name))
    if heading("Transform"):
        form.number((*at, "transform", "translation"))
        form.rotation((*at, "transform", "rotation"))
        form.number((*at, "transform", "scale"))
        _mirror(form, index, shape)
    if shape.groups and heading("Groups"):
        _groups(form, index, shape)
    if heading("Frame in four-space", opened=False):
        frame.draw(form, index)


def _strips(form: Form, index: int, shape: Shape) -> None:
    """The exponent and the half-width of every strip, the two numbers that shape it most."""
    gamma, half_width = FIELDS["shapes[].strips[].gamma"], FIELDS["shapes[].strips[].half_width"]
    if not imgui.begin_table("strips", 3, imgui.TableFlags_.sizing_stretch_prop):
        return
    for title, weight in (("Strip", 1.1), (gamma.label, 1.0), (half_width.label, 1.0)):
        imgui.table_setup_column(title, imgui.TableColumnFlags_.width_stretch, weight)
    imgui.table_headers_row()
    if len(shape.strips) > 1:
        _all_strips(form, index, shape)
    for number, strip in enumerate(shape.strips):
        at = ("shapes", index, "strips", number)
        imgui.table_next_row()
        imgui.table_next_column()
        imgui.align_text_to_frame_padding()
        if imgui.text_link(strip_label(strip, number)):
            form.intents.append(Select(index, number))
        imgui.set_item_tooltip(strip_name(strip, number))
        imgui.table_next_column()
        form.slider((*at, "gamma"), gamma, gamma.label)
        imgui.table_next_column()
        form.slider((*at, "half_width"), half_width, half_width.label)
    imgui.end_table()
    if imgui.button("Add Strip"):
        form.intents.append(Do("add strip"))


def _all_strips(form: Form, index: int, shape: Shape) -> None:
    """One slider for all strips at once: it rounds or sharpens, thins or thickens the whole shape."""
    imgui.table_next_row()
    imgui.table_next_column()
    imgui.align_text_to_frame_padding()
    imgui.text_unformatted("All")
    for name in ("gamma", "half_width"):
        imgui.table_next_column()
        every = [("shapes", index, "strips", number, name) for number in range(len(shape.strips))]
        form.together(("shapes", index, "strips", name), every, FIELDS[f"shapes[].strips[].{name}"])


def _mirror(form: Form, index: int, shape: Shape) -> None:
    """A check box for each axis."""
    form.label("Mirror", "Adds the shape's mirror image in the world's plane x = 0, y = 0 or z = 0.")
    for axis in ("x", "y", "z"):
        changed, on = imgui.checkbox(f"{axis}##mirror", axis in shape.mirror)
        if changed:
            axes = tuple(other for other in ("x", "y", "z") if (on if other == axis else other in shape.mirror))
            form.intents.append(Put(("shapes", index, "mirror"), axes, "Mirror"))
        imgui.same_line()
    imgui.new_line()


def _groups(form: Form, index: int, shape: Shape) -> None:
    for name in shape.groups:
        at = ("shapes", index, "groups", name)
        members = [number for number, strip in enumerate(shape.strips) if strip.group == name]
        imgui.separator_text(f"{name}: {', '.join(f'strip {number + 1}' for number in members) or 'no strips'}")
        form.number((*at, "gamma"))
        form.choice((*at, "sign"), "Sign", _SIGNS, _help("sign"))


def _strip(form: Form, index: int, number: int, shape: Shape) -> None:
    at, strip = ("shapes", index, "strips", number), shape.strips[number]
    if imgui.text_link(f"{shape_name(shape, index)}"):
        form.intents.append(Select(index))
    imgui.same_line()
    imgui.text_disabled(f"/  {strip_name(strip, number)}")
    imgui.spacing()
    for name in ("gamma", "half_width", "offset", "normal", "slice"):
        form.number((*at, name))
    if strip.group is None:
        form.choice((*at, "sign"), "Sign", _SIGNS, _help("sign"))
    _group(form, index, number, shape)
    if strip.group is not None:
        imgui.separator_text(f"Group {strip.group}")
        form.number(("shapes", index, "groups", strip.group, "gamma"))
        form.choice(("shapes", index, "groups", strip.group, "sign"), "Sign", _SIGNS, _help("sign"))


def _group(form: Form, index: int, number: int, shape: Shape) -> None:
    """Which group the strip belongs to; a new one can be made here."""
    present = shape.strips[number].group
    form.label("Group", _help("group"))
    imgui.set_next_item_width(-1)
    if not imgui.begin_combo("##group", present or _ALONE):
        return
    if imgui.selectable(_ALONE, present is None)[0] and present is not None:
        form.intents.append(Edit("Ungroup", partial(edit.ungroup, shape=index, indices=[number])))
    for name in shape.groups:
        if imgui.selectable(f"{name}##named", name == present)[0] and name != present:
            form.intents.append(Edit("Group", partial(edit.set_group, shape=index, indices=[number], name=name)))
    if imgui.selectable("New group", False)[0]:
        form.intents.append(Edit("Group", partial(edit.set_group, shape=index, indices=[number])))
    imgui.end_combo()


def heading(title: str, opened: bool = True) -> bool:
    """A section that folds, open at first or not; whether it is open."""
    imgui.spacing()
    imgui.push_style_color(imgui.Col_.header, imgui.get_style_color_vec4(imgui.Col_.table_header_bg))
    shown = imgui.collapsing_header(title, imgui.TreeNodeFlags_.default_open if opened else imgui.TreeNodeFlags_.none)
    imgui.pop_style_color()
    return bool(shown)


def _help(name: str) -> str:
    return Strip.model_fields[name].description or ""
