"""The tools in the viewport's corner, how the one in hand is set, and what its drag does."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from ..intents import Equip, Intent
from ..session import Session
from ..theme import ACCENT
from ..tools.kit import TOOLS
from ..tools.sculpting import WAYS

_WAYS = {"one": "One plane", "both": "Both planes", "slide": "Slide the strip"}
_EXPONENTS = {"pat": (2.0, 100.0), "chop": (2.0, 400.0)}


def draw(session: Session, corner: imgui.ImVec2) -> list[Intent]:
    """A column of buttons, the tool in hand lit; to the right of it that tool's settings."""
    em = imgui.get_font_size()
    kit, intents = session.kit, list[Intent]()
    imgui.set_cursor_screen_pos((corner.x + 0.6 * em, corner.y + 2.2 * em))
    imgui.begin_group()
    for name, tool in TOOLS.items():
        lit = name == kit.tool
        if lit:
            imgui.push_style_color(imgui.Col_.button, ACCENT)
        if imgui.button(f"{tool.icon}###tool {name}", (2.2 * em, 2.0 * em)):
            intents.append(Equip(replace(kit, tool=name)))
        if lit:
            imgui.pop_style_color()
        imgui.set_item_tooltip(f"{tool.label} ({tool.key})\n{tool.hint}")
    imgui.end_group()
    imgui.set_cursor_screen_pos((corner.x + 3.4 * em, corner.y + 2.2 * em))
    return intents + _settings(session)


def _settings(session: Session) -> list[Intent]:
    kit = session.kit
    if kit.tool == "faces":
        imgui.set_next_item_width(9 * imgui.get_font_size())
        chosen = kit.way
        if imgui.begin_combo("##way", _WAYS[kit.way]):
            for way in WAYS:
                if imgui.selectable(_WAYS[way], way == kit.way)[0]:
                    chosen = way
            imgui.end_combo()
        imgui.set_item_tooltip("What a push moves; Tab changes it while dragging.")
        return [] if chosen == kit.way else [Equip(replace(kit, way=chosen))]
    if kit.tool in _EXPONENTS:
        low, high = _EXPONENTS[kit.tool]
        imgui.set_next_item_width(9 * imgui.get_font_size())
        value = kit.pat if kit.tool == "pat" else kit.chop
        changed, value = imgui.slider_float(
            "##flatness", value, low, high, "flatness %.1f", imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp
        )
        imgui.set_item_tooltip("The exponent of the planes that this tool adds: higher is flatter, with sharper edges.")
        if changed:
            return [Equip(replace(kit, pat=value) if kit.tool == "pat" else replace(kit, chop=value))]
    return []
