"""What the mouse does and every key, by the menu that the action is in: columns as there is room, scrolled where there is not."""

from __future__ import annotations

from collections.abc import Sequence

from imgui_bundle import imgui

from ..asks import Dialog, Shortcuts
from ..intents import Answer, Intent
from .buttons import buttons

Row = tuple[str, str]

_MOUSE: dict[str, tuple[Row, ...]] = {
    "Mouse": (
        ("Orbit", "Middle drag, drag beside the body"),
        ("Pan", "Right drag, Shift + middle drag"),
        ("Zoom to the pointer", "Wheel"),
        ("Zoom", "Ctrl + middle drag"),
        ("As in Maya", "Alt + any button"),
        ("Orbit, pan on a trackpad", "Two fingers sideways, with Shift"),
        ("Select", "Click, Ctrl + click for several"),
    ),
    "Clay": (
        ("Push a face", "Drag it, Tab for another way"),
        ("Tilt, soften a face", "Click it, drag its ring, diamond"),
        ("A face's exponent", "Ctrl + wheel over it"),
        ("Remove a face", "Drag it out of the body"),
        ("While dragging", "Shift fine, Ctrl snaps, Esc back"),
        ("Be exact", "Type a number while dragging"),
    ),
    "Sliders": (
        ("Type a number", "Ctrl + click"),
        ("Back to the default", "Double click"),
        ("Reset, animate", "Right click"),
    ),
}
# The widths of a label and of its keys, in those of the font; and the share of the window that the sheet may take.
_WIDTHS, _GAP, _SHARE = (10.0, 13.8), 1.2, 0.95


def draw(dialog: Dialog) -> list[Intent]:
    assert isinstance(dialog, Shortcuts)
    groups = {**_MOUSE, **_keys(dialog)}
    view, em = imgui.get_main_viewport().work_size, imgui.get_font_size()
    column = (sum(_WIDTHS) + _GAP) * em
    columns = _columns(groups, max(1, int(_SHARE * view.x / column)))
    longest = max(_height(groups, names) for names in columns) * imgui.get_text_line_height_with_spacing()
    room = _SHARE * view.y - 4 * imgui.get_frame_height_with_spacing()
    width = len(columns) * column + (imgui.get_style().scrollbar_size if longest > room else 0)
    if imgui.begin_child("sheet", (width, min(longest, room))):
        for number, names in enumerate(columns):
            if number:
                imgui.same_line(number * column)
            imgui.begin_group()
            for name in names:
                _group(name, groups[name])
            imgui.end_group()
    imgui.end_child()
    return [Answer()] if buttons(["Close"]) else []


def _keys(dialog: Shortcuts) -> dict[str, list[Row]]:
    """Menu by menu, the actions that have keys."""
    groups: dict[str, list[Row]] = {}
    for command in dialog.commands:
        if command.keys:
            label = f"{command.within} {command.label}" if command.within == "Look From" else command.label
            groups.setdefault(command.menu, []).append((label.rstrip("."), ", ".join(command.keys)))
    return groups


def _height(groups: dict[str, Sequence[Row]], names: Sequence[str]) -> int:
    """In lines: each group has a heading and a blank after it."""
    return sum(len(groups[name]) + 2 for name in names)


def _columns(groups: dict[str, Sequence[Row]], count: int) -> list[list[str]]:
    """The groups in order, in at most so many columns, the longest of which is as short as can be."""
    lowest = max(_height(groups, [name]) for name in groups)
    for height in range(lowest, _height(groups, list(groups)) + 1):
        columns: list[list[str]] = [[]]
        for name in groups:
            if columns[-1] and _height(groups, [*columns[-1], name]) > height:
                columns.append([])
            columns[-1].append(name)
        if len(columns) <= count:
            return columns
    return [list(groups)]


def _group(name: str, rows: Sequence[Row]) -> None:
    imgui.text_unformatted(name)
    left, em = imgui.get_cursor_pos_x(), imgui.get_font_size()
    for label, keys in rows:
        imgui.text_disabled(label)
        imgui.same_line(0, 0)
        imgui.set_cursor_pos_x(left + _WIDTHS[0] * em)
        imgui.text_unformatted(keys)
    imgui.dummy((sum(_WIDTHS) * em, imgui.get_text_line_height()))
