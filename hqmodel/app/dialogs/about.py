"""What the program is, and every shortcut."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version

from imgui_bundle import imgui

from ..actions import ACTIONS
from ..asks import Dialog
from ..intents import Answer, Intent
from .buttons import buttons

_NAVIGATION = (
    ("Orbit", "Drag, or middle button"),
    ("Pan", "Right button, Shift + drag"),
    ("Zoom to the cursor", "Wheel"),
    ("Zoom", "Ctrl + drag"),
    ("Select", "Click;  Ctrl + click for several"),
    ("Type a number", "Ctrl + click on a slider"),
    ("Reset a number", "Double click on a slider"),
)


def draw(_: Dialog) -> list[Intent]:
    imgui.text_unformatted(f"hqmodel {_version()}")
    imgui.text_unformatted("Shapes hyperquadrics like clay.")
    imgui.spacing()
    imgui.text_disabled("A. J. Hanson, Hyperquadrics: Smoothly Deformable Shapes with Convex Polyhedral Bounds,")
    imgui.text_disabled("Computer Vision, Graphics, and Image Processing 44, 191-210 (1988).")
    imgui.spacing()
    imgui.text_disabled("Free software under the MIT license.")
    return [Answer()] if buttons(["Close"]) else []


def draw_shortcuts(_: Dialog) -> list[Intent]:
    """Two tables side by side: the mouse, and the keys as the table of actions has them."""
    keys = [(_label(name), "  or  ".join(action.shortcuts)) for name, action in ACTIONS.items() if action.shortcuts]
    half = (len(keys) + len(_NAVIGATION)) // 2
    rows = [*_NAVIGATION, *keys]
    _table("left", rows[:half])
    imgui.same_line(0, 3 * imgui.get_font_size())
    _table("right", rows[half:])
    return [Answer()] if buttons(["Close"]) else []


def _label(name: str) -> str:
    label = ACTIONS[name].label.rstrip(".")
    return f"Look from {label.lower()}" if name.startswith("view ") else label


def _table(name: str, rows: list[tuple[str, str]]) -> None:
    imgui.begin_group()
    if imgui.begin_table(name, 2, imgui.TableFlags_.sizing_fixed_fit | imgui.TableFlags_.no_host_extend_x):
        for label, keys in rows:
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.text_unformatted(label)
            imgui.table_next_column()
            imgui.text_disabled(keys)
        imgui.end_table()
    imgui.end_group()


def _version() -> str:
    try:
        return version("hqmodel")
    except PackageNotFoundError:  # run from a checkout that is not installed
        return "(not installed)"
