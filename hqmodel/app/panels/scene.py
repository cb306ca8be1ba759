"""The scene as a whole: how its shapes blend, the box it is cut by, and what is said about it."""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import imgui

from hqmodel import edit
from hqmodel.model import FIELDS, Scene

from ..form import Form, Memory
from ..intents import Edit, Intent, Put, Select
from ..session import Session
from .naming import shape_name

_DIMENSIONS: dict[str, tuple[int, Callable[[Scene], Scene]]] = {"Solid": (3, edit.extruded), "Flat": (2, edit.flattened)}


def draw(session: Session, memory: Memory) -> list[Intent]:
    """The composite's numbers first, then the bounds, then the words."""
    form = Form(session.scene, memory)
    form.number(("level",))
    _composite(form)
    imgui.spacing()
    _dimension(form)
    _bounds(form, session)
    imgui.separator_text("About")
    form.text(("name",), "Name")
    form.text(("author",), "Author")
    form.text(("license",), "License")
    form.text(("description",), "Description", lines=5)
    return form.intents


def _composite(form: Form) -> None:
    """Every shape's coefficient and hardness side by side: they work against each other."""
    shapes = form.scene.shapes
    if not shapes or not imgui.begin_table("composite", 3, imgui.TableFlags_.sizing_stretch_prop):
        return
    columns = [("coefficient", FIELDS["shapes[].coefficient"]), ("hardness", FIELDS["shapes[].hardness"])]
    imgui.table_setup_column("Shape")
    for _, spec in columns:
        imgui.table_setup_column(spec.label)
    imgui.table_headers_row()
    for index, shape in enumerate(shapes):
        imgui.table_next_row()
        imgui.table_next_column()
        imgui.align_text_to_frame_padding()
        if imgui.text_link(f"{shape_name(shape, index)}##{index}"):
            form.intents.append(Select(index))
        for name, spec in columns:
            imgui.table_next_column()
            form.slider(("shapes", index, name), spec, spec.label)
    imgui.end_table()


def _dimension(form: Form) -> None:
    """Solid or flat; the strips are made to fit."""
    form.label("Dimension", "Flat: the outline in the plane z = 0, of strips without a z part.")
    for name, (dimension, change) in _DIMENSIONS.items():
        if imgui.radio_button(f"{name}##dimension", form.scene.dimension == dimension) and form.scene.dimension != dimension:
            form.intents.append(Edit(name, change))
        imgui.same_line()
    imgui.new_line()


def _bounds(form: Form, session: Session) -> None:
    """Whether there is a box, and its two corners."""
    bounds = form.scene.bounds
    form.label("Bounds", FIELDS["bounds[][]"].help)
    changed, on = imgui.checkbox("##bounds", bounds is not None)
    if changed:
        box = tuple(tuple(round(float(part), 3) for part in corner) for corner in (session.region.low, session.region.high))
        form.intents.append(Put(("bounds",), box if on else None, "Bounds"))
    imgui.same_line()
    imgui.text_disabled("cut by this box" if bounds else "worked out from the shapes")
    if bounds is not None:
        form.number(("bounds", 0), "Low corner")
        form.number(("bounds", 1), "High corner")
