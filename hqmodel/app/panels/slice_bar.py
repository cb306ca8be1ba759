"""The slice t along the bottom: it slides the shape through its further dimension."""

from __future__ import annotations

from imgui_bundle import imgui

from hqmodel.model import FIELDS

from ..form import Form, Memory
from ..intents import Intent
from ..session import Session


def draw(session: Session, memory: Memory) -> list[Intent]:
    """One slider across the window, dimmed where no strip moves with the slice."""
    form = Form(session.scene, memory)
    still = not any(strip.slice for shape in session.scene.shapes for strip in shape.strips)
    imgui.align_text_to_frame_padding()
    imgui.text_unformatted(FIELDS["slice"].label)
    imgui.same_line()
    note = "no strip has a slice rate yet: nothing moves"
    if still:
        imgui.push_style_var(imgui.StyleVar_.alpha, imgui.get_style().alpha * 0.6)
    width = imgui.calc_text_size(note).x + 2 * imgui.get_style().item_spacing.x if still else 1.0
    form.slider(("slice",), FIELDS["slice"], FIELDS["slice"].label, width=-width)
    if still:
        imgui.same_line()
        imgui.text_unformatted(note)
        imgui.pop_style_var()
    return form.intents
