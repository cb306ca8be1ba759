"""How points or a mesh shall be fitted: by how many bodies, of how many strips."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from ..asks import Dialog, ImportAs
from ..intents import Adjust, Answer, Intent
from .buttons import buttons

_MOST_PARTS, _MOST_STRIPS = 16, 16


def draw(dialog: Dialog) -> list[Intent]:
    """The file, and two numbers."""
    assert isinstance(dialog, ImportAs)
    settings = dialog.settings
    imgui.text_unformatted(settings.path.name)
    imgui.set_item_tooltip(str(settings.path))
    imgui.text_disabled("Hyperquadrics are fitted to its points; meshes are sampled evenly.")
    imgui.spacing()
    changed, found = imgui.checkbox("Find the number of parts", settings.parts is None)
    if changed:
        settings = replace(settings, parts=None if found else 1)
    if settings.parts is not None:
        imgui.set_next_item_width(14 * imgui.get_font_size())
        changed, parts = imgui.slider_int("Parts at most##parts", settings.parts, 1, _MOST_PARTS)
        settings = replace(settings, parts=min(max(parts, 1), 64)) if changed else settings
    imgui.set_next_item_width(14 * imgui.get_font_size())
    changed, strips = imgui.slider_int("Strips in each at most##strips", settings.strips, 3, _MOST_STRIPS)
    settings = replace(settings, strips=min(max(strips, 3), 32)) if changed else settings
    pressed = buttons(["Fit", "Cancel"])
    if pressed is not None:
        return [Answer(settings if pressed == "Fit" else None)]
    return [Adjust(ImportAs(settings))] if settings != dialog.settings else []
