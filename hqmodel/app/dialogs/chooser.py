"""A file dialog of our own, for where the system has none that we could use."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from ..asks import ChooseFile, Dialog
from ..browse import Listing, listing
from ..intents import Adjust, Answer, Intent
from ..panels.status import ERROR, NOTICE
from .buttons import buttons, entered

_SIZE = 34.0, 16.0
_VERBS = {"open": "Open", "save": "Save", "export": "Choose", "import": "Import"}


def draw(dialog: Dialog) -> list[Intent]:
    """The folder, what is in it, and the name."""
    assert isinstance(dialog, ChooseFile)
    found = listing(dialog.folder, dialog.endings)
    chosen = _folder(dialog)
    picked, at_once = _list(dialog, found)
    chosen = picked or chosen
    imgui.set_next_item_width(_SIZE[0] * imgui.get_font_size())
    typed, name = imgui.input_text_with_hint("##name", "Name", dialog.name)
    if typed:
        chosen = replace(dialog, name=name, replacing=False)
    at_once = at_once or (imgui.is_item_deactivated() and entered())
    problem = found.problem or _problem(dialog)
    if dialog.replacing:
        imgui.text_colored(NOTICE, f"{dialog.path.name} is there already. Replace it?")
    elif found.problem:
        imgui.text_colored(ERROR, found.problem)
    verb = "Replace" if dialog.replacing else _VERBS[dialog.purpose]
    pressed = buttons([verb, "Cancel"], enabled=not problem)
    if pressed == "Cancel":
        return [Answer()]
    if chosen is None and (pressed == verb or (at_once and not problem)):
        return _taken(dialog)
    return [Adjust(chosen)] if chosen is not None else []


def _folder(dialog: ChooseFile) -> ChooseFile | None:
    """Up, home, and the path itself, to be typed."""
    target = None
    if imgui.button(icons.ICON_FA_ARROW_UP + "##up"):
        target = dialog.folder.parent
    imgui.set_item_tooltip("Up to the parent folder")
    imgui.same_line()
    if imgui.button(icons.ICON_FA_HOUSE + "##home"):
        target = Path.home()
    imgui.set_item_tooltip("Home folder")
    imgui.same_line()
    imgui.set_next_item_width(_SIZE[0] * imgui.get_font_size() - imgui.get_cursor_pos_x() + imgui.get_style().window_padding.x)
    entered, text = imgui.input_text("##folder", str(dialog.folder), imgui.InputTextFlags_.enter_returns_true)
    if entered:
        target = Path(text).expanduser().absolute()
    return None if target is None else _moved(dialog, target)


def _moved(dialog: ChooseFile, target: Path) -> ChooseFile:
    """A folder to go to; a file's own path typed there chooses that file."""
    if target.is_file() or (target.suffix.lower() in dialog.endings and target.parent.is_dir() and not target.is_dir()):
        return replace(dialog, folder=target.parent, name=target.name, replacing=False)
    return replace(dialog, folder=target, replacing=False)


def _list(dialog: ChooseFile, found: Listing) -> tuple[ChooseFile | None, bool]:
    """What was clicked, and whether with a double click on the file that is chosen by now."""
    chosen, at_once = None, False
    width, height = (part * imgui.get_font_size() for part in _SIZE)
    if imgui.begin_child("list", (width, height), imgui.ChildFlags_.frame_style):
        for name in found.folders:
            if imgui.selectable(f"{icons.ICON_FA_FOLDER}  {name}##folder", False)[0]:
                chosen = replace(dialog, folder=dialog.folder / name, replacing=False)
        for name in found.files:
            flags = imgui.SelectableFlags_.allow_double_click
            if imgui.selectable(f"{icons.ICON_FA_FILE}  {name}##file", name == dialog.name, flags)[0]:
                if imgui.is_mouse_double_clicked(imgui.MouseButton_.left) and name == dialog.name:
                    at_once = True
                else:
                    chosen = replace(dialog, name=name, replacing=False)
        if not (found.folders or found.files or found.problem):
            imgui.text_disabled("Nothing here")
    imgui.end_child()
    return chosen, at_once


def _problem(dialog: ChooseFile) -> bool:
    """Whether there is nothing yet that could be taken."""
    return not dialog.name.strip() or (dialog.reading and not dialog.path.is_file())


def _taken(dialog: ChooseFile) -> list[Intent]:
    if not dialog.reading and dialog.path.exists() and not dialog.replacing:
        return [Adjust(replace(dialog, replacing=True))]
    return [Answer(dialog.path)]
