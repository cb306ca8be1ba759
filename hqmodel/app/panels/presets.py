"""The built-in presets and the recent files: a click opens one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from imgui_bundle import imgui

from hqmodel.files import Builtin

from ..asks import Open
from ..intents import Intent
from ..session import Session

# The side of a thumbnail, in widths of the font.
THUMBNAIL = 4.0
# As much of a description as there is room for beside it; all of it is in the tooltip.
LINES = 2


@dataclass
class Shelf:
    """What the panel remembers: what there is, and the words it is searched for."""

    presets: Sequence[Builtin]
    search: str = ""

    def found(self) -> list[Builtin]:
        """Those that have all the words somewhere."""
        words = self.search.casefold().split()
        return [preset for preset in self.presets if all(word in _said(preset) for word in words)]


def _said(preset: Builtin) -> str:
    return f"{preset.title} {preset.name} {preset.description} {preset.collection}".casefold()


def draw(session: Session, shelf: Shelf, thumbnail: Callable[[Builtin], int | None]) -> list[Intent]:
    """`thumbnail` gives the texture with a preset's picture, None while there is none yet."""
    intents: list[Intent] = []
    imgui.set_next_item_width(-1)
    _, shelf.search = imgui.input_text_with_hint("##search", "Search", shelf.search)
    if imgui.begin_child("presets"):
        collection = None
        for preset in shelf.found():
            if preset.collection != collection:
                collection = preset.collection
                imgui.separator_text(collection.capitalize())
            if _row(preset, thumbnail):
                intents.append(Open(preset.path))
    imgui.end_child()
    return intents


def _row(preset: Builtin, thumbnail: Callable[[Builtin], int | None]) -> bool:
    """Picture, title and the description, as far as there is room."""
    side = imgui.get_font_size() * THUMBNAIL
    start = imgui.get_cursor_pos()
    clicked, _ = imgui.selectable(f"##{preset.name}", False, size=(0, side))
    imgui.set_item_tooltip(preset.description or preset.title)
    seen = imgui.is_item_visible()
    after = imgui.get_cursor_pos()
    if seen:
        imgui.set_cursor_pos(start)
        texture = thumbnail(preset)
        if texture is None:
            imgui.dummy((side, side))
        else:
            imgui.image(imgui.ImTextureRef(texture), (side, side), (0, 1), (1, 0))
        imgui.same_line()
        imgui.begin_group()
        imgui.text_unformatted(preset.title)
        imgui.push_style_color(imgui.Col_.text, imgui.get_style_color_vec4(imgui.Col_.text_disabled))
        room = imgui.get_cursor_screen_pos()
        imgui.push_clip_rect(room, (room.x + 10_000, room.y + LINES * imgui.get_text_line_height()), True)
        imgui.text_wrapped(preset.description)
        imgui.pop_clip_rect()
        imgui.pop_style_color()
        imgui.end_group()
    imgui.set_cursor_pos(after)
    imgui.dummy((0, 0))
    return bool(clicked)
