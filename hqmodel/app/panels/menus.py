"""The menu bar, and the shortcuts that the same table of actions declares."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

from imgui_bundle import imgui

from ..actions import ACTIONS, MENUS, RECENT, Entry
from ..asks import Open
from ..intents import Do, Intent
from ..session import Session

_MODIFIERS = {"Ctrl": imgui.Key.mod_ctrl, "Shift": imgui.Key.mod_shift, "Alt": imgui.Key.mod_alt}
_RELEASED = {
    imgui.Key.mod_ctrl: (imgui.Key.left_ctrl, imgui.Key.right_ctrl),
    imgui.Key.mod_shift: (imgui.Key.left_shift, imgui.Key.right_shift),
    imgui.Key.mod_alt: (imgui.Key.left_alt, imgui.Key.right_alt),
}
_KEYS = {
    "Del": "delete",
    "Up": "up_arrow",
    "Down": "down_arrow",
    "Num .": "keypad_decimal",
    "Num /": "keypad_divide",
    "[": "left_bracket",
    "]": "right_bracket",
    **{str(digit): f"_{digit}" for digit in range(10)},
}


def draw(session: Session) -> list[Intent]:
    """The menus; the chosen action, if any."""
    intents: list[Intent] = []
    for title, entries in MENUS.items():
        if imgui.begin_menu(title):
            for entry in entries:
                intents += _entry(session, entry)
            imgui.end_menu()
    return intents


def shortcuts(session: Session) -> list[Intent]:
    """The actions whose keys were pressed; none while a dialog waits for its answer or the hand holds something."""
    if session.dialogs or session.held:
        return []
    with _quick_modifiers():
        pressed = [
            name
            for name, action in ACTIONS.items()
            for keys in action.shortcuts
            if imgui.shortcut(chord(keys), imgui.InputFlags_.route_global)
        ]
    # Of several in one slow frame only one is meant for us: G and X are a move along x, not a move and a deletion.
    return [Do(min(pressed, key=lambda name: not name.startswith("hold ")))] if pressed else []


@contextmanager
def _quick_modifiers() -> Iterator[None]:
    """Modifiers that were let go in this frame count as held: in a slow frame the key they were pressed with comes with it."""
    io = imgui.get_io()
    before = io.key_mods
    for modifier, keys in _RELEASED.items():
        if any(imgui.is_key_released(key) for key in keys):
            io.key_mods |= int(modifier)
    yield
    io.key_mods = before


@cache
def chord(keys: str) -> int:
    """ImGui's number for keys as people write them, Ctrl+Shift+Z; on a Mac ImGui takes Ctrl to be Cmd."""
    *modifiers, key = keys.split("+")
    name = _KEYS.get(key) or (key.replace("Num ", "keypad") if key.startswith("Num ") else key.lower())
    total = int(imgui.Key[name])
    for modifier in modifiers:
        total |= int(_MODIFIERS[modifier])
    return total


def _entry(session: Session, entry: Entry) -> list[Intent]:
    if entry is None:
        imgui.separator()
        return []
    if entry == RECENT:
        return _recent(session)
    if isinstance(entry, str):
        return _item(session, entry)
    title, names = entry
    if not imgui.begin_menu(title):
        return []
    intents = [intent for name in names for intent in _item(session, name)]
    imgui.end_menu()
    return intents


def _item(session: Session, name: str) -> list[Intent]:
    action = ACTIONS[name]
    keys = action.shortcuts[0] if action.shortcuts else ""
    checked = action.checked(session) if action.checked else False
    chosen = imgui.menu_item_simple(f"{action.title(session)}###{name}", keys, checked, action.enabled(session))
    return [Do(name)] if chosen else []


def _recent(session: Session) -> list[Intent]:
    files = [Path(name) for name in session.settings.recent]
    if not imgui.begin_menu("Open Recent", bool(files)):
        return []
    intents: list[Intent] = []
    for number, path in enumerate(files):
        if imgui.menu_item_simple(f"{path.name}##{number}"):
            intents.append(Open(path))
        imgui.set_item_tooltip(str(path))
    imgui.end_menu()
    return intents
