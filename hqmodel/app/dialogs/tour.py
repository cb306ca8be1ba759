"""The first-run tour: five steps, each with a frame around what it is about."""

from __future__ import annotations

from dataclasses import dataclass, replace

from imgui_bundle import imgui

from ..asks import Dialog, Tour
from ..intents import Adjust, Answer, Intent
from ..theme import ACCENT
from .buttons import buttons

_WIDTH = 26.0


@dataclass(frozen=True)
class Step:
    """What it is about, the window it frames (or the beginning of that one's name), and what there is to say."""

    title: str
    window: str
    text: str


STEPS = (
    Step(
        "Begin with a shape",
        "Presets",
        "Click a preset to open it, or add shapes from the Add menu. A preset that came with the program is never changed: "
        "saving asks where to.",
    ),
    Step(
        "Shape it with your hands",
        "Viewport",
        "Every face of the clay is one of two parallel planes. Drag a face to push its plane, press to pat, draw a line to "
        "chop: the tools are on the left, on the keys 1 to 8. Drag beside the body, or with the middle button, to turn the view.",
    ),
    Step(
        "Fine work is done with sliders",
        "Properties",
        "The exponent pulls the clay flat against a plane: 2 is round, 40 nearly flat, below 1 pinched. Ctrl + click types a "
        "number, a double click puts it back, a right click sets it in motion. Rest the pointer on a label to read what it does.",
    ),
    Step(
        "There is a fourth dimension",
        "##Bottom",
        "A shape can be a slice through a body of more dimensions. Where its planes have a slice rate, t slides the slice "
        "along; press play and watch.",
    ),
    Step(
        "Nothing is lost",
        "##MainMenuBar",
        "Ctrl+Z takes back everything, step by step, and copies are kept while you work. Ctrl+S saves, Ctrl+E exports a mesh, "
        "Ctrl+P finds any command, F1 shows every key. This tour is in the Help menu.",
    ),
)


def draw(dialog: Dialog) -> list[Intent]:
    """One step, and the way to the next."""
    assert isinstance(dialog, Tour)
    step, last = STEPS[dialog.step], len(STEPS) - 1
    _frame(step.window)
    imgui.text_unformatted(step.title)
    imgui.same_line()
    imgui.text_disabled(f"{dialog.step + 1} of {len(STEPS)}")
    imgui.spacing()
    imgui.push_text_wrap_pos(imgui.get_cursor_pos_x() + _WIDTH * imgui.get_font_size())
    imgui.text_unformatted(step.text)
    imgui.pop_text_wrap_pos()
    onward = "Start" if dialog.step == last else "Next"
    labels = [onward, *(["Back"] if dialog.step else []), *(["Skip"] if dialog.step < last else [])]
    pressed = buttons(labels)
    if pressed in ("Next", "Back"):
        return [Adjust(replace(dialog, step=dialog.step + (1 if pressed == "Next" else -1)))]
    return [Answer()] if pressed else []


def _frame(name: str) -> None:
    """A frame around the window of that name, above everything; none where it is not shown."""
    for window in imgui.get_current_context().windows:
        if window.name.startswith(name) and window.was_active and not window.hidden:
            low, high = window.pos, imgui.ImVec2(window.pos.x + window.size.x, window.pos.y + window.size.y)
            thick = imgui.get_font_size() / 6
            imgui.get_foreground_draw_list().add_rect(low, high, imgui.get_color_u32(ACCENT), thickness=thick)
            return
