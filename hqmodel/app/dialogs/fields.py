"""Rows of a dialog: the label on the left, the control on the right."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TypeVar

from imgui_bundle import imgui

Key = TypeVar("Key")

_LABEL, _WIDTH = 8.0, 24.0


def label(text: str) -> None:
    """The label, and the cursor and the width for the control."""
    imgui.align_text_to_frame_padding()
    imgui.text_unformatted(text)
    imgui.same_line(_LABEL * imgui.get_font_size())
    imgui.set_next_item_width(_WIDTH * imgui.get_font_size())


def combo(text: str, present: Key, options: Mapping[Key, str]) -> Key:
    """One of the options' keys, chosen by their names."""
    label(text)
    if imgui.begin_combo(f"##{text}", options.get(present, str(present))):
        for key, name in options.items():
            if imgui.selectable(name, key == present)[0]:
                present = key
        imgui.end_combo()
    return present


def file(path: Path) -> tuple[Path, bool]:
    """A file's path, to be typed, and whether to browse for it."""
    label("File")
    browse, style = "Browse...", imgui.get_style()
    wide = imgui.calc_text_size(browse).x + 2 * style.frame_padding.x + style.item_spacing.x
    imgui.set_next_item_width(_WIDTH * imgui.get_font_size() - wide)
    changed, text = imgui.input_text("##file", str(path))
    imgui.same_line()
    return Path(text) if changed and Path(text).name else path, imgui.button(browse)
