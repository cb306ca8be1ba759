"""Presets with their pictures, in sections that fold: a click opens one, its star makes it a favourite."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from ..asks import Open
from ..intents import Intent, Prefer
from ..session import Session
from ..shelf import Card, Shelf, favourites, own_folder
from ..theme import ACCENT
from .properties import heading

# The side of a thumbnail, in widths of the font.
THUMBNAIL = 4.0
# As much of a description as there is room for beside it; all of it is in the tooltip.
LINES = 2

# Over the list, be it that the star is just being pressed.
_POINTED = imgui.HoveredFlags_.child_windows | imgui.HoveredFlags_.allow_when_blocked_by_active_item

Thumbnail = Callable[[Path], int | None]


def draw(session: Session, shelf: Shelf, thumbnail: Thumbnail) -> list[Intent]:
    """`thumbnail` gives the texture with a preset's picture, None while there is none yet."""
    intents: list[Intent] = []
    imgui.set_next_item_width(-1)
    _, shelf.search = imgui.input_text_with_hint("##search", "Search", shelf.search)
    imgui.set_item_tooltip(f"Presets in {own_folder()} are listed too")
    starred = favourites(session.settings)
    if imgui.begin_child("presets"):
        found = shelf.found(session.settings)
        if not found:
            imgui.text_disabled("No preset has these words")
        for section, cards in found.items():
            if heading(section):
                imgui.push_id(section)
                for card in cards:
                    intents += _row(card, str(card.path) in starred, starred, thumbnail)
                imgui.pop_id()
    imgui.end_child()
    return intents


def _row(card: Card, star: bool, starred: list[str], thumbnail: Thumbnail) -> list[Intent]:
    """Picture, title, the description as far as there is room, and a star."""
    side = imgui.get_font_size() * THUMBNAIL
    start, room = imgui.get_cursor_pos(), imgui.get_content_region_avail().x
    flags = imgui.SelectableFlags_.allow_overlap
    intents: list[Intent] = [Open(card.path)] if imgui.selectable(f"##{card.name}", False, flags, (0, side))[0] else []
    imgui.set_item_tooltip(card.description or card.title)
    after = imgui.get_cursor_pos()
    if imgui.is_item_visible():
        pointed = imgui.is_mouse_hovering_rect(imgui.get_item_rect_min(), imgui.get_item_rect_max())
        imgui.set_cursor_pos(start)
        wide = 1.2 * imgui.get_frame_height()
        _contents(card, side, start.x + room - wide, thumbnail(card.path))
        if star or (pointed and imgui.is_window_hovered(_POINTED)):
            imgui.set_cursor_pos((start.x + room - wide, start.y))
            intents += _star(card, star, starred, wide)
    imgui.set_cursor_pos(after)
    imgui.dummy((0, 0))
    return intents


def _contents(card: Card, side: float, right: float, texture: int | None) -> None:
    """All of a row but its star, which begins at `right`."""
    if texture is None:
        imgui.dummy((side, side))
    else:
        imgui.image(imgui.ImTextureRef(texture), (side, side), (0, 1), (1, 0))
    imgui.same_line()
    imgui.begin_group()
    at, line = imgui.get_cursor_screen_pos(), imgui.get_text_line_height()
    imgui.push_clip_rect(at, (at.x + right - imgui.get_cursor_pos_x(), at.y + line), True)
    imgui.text_unformatted(card.title)
    imgui.pop_clip_rect()
    at = imgui.get_cursor_screen_pos()
    imgui.push_style_color(imgui.Col_.text, imgui.get_style_color_vec4(imgui.Col_.text_disabled))
    imgui.push_clip_rect(at, (at.x + 10_000, at.y + LINES * line), True)
    imgui.text_wrapped(card.description)
    imgui.pop_clip_rect()
    imgui.pop_style_color()
    imgui.end_group()


def _star(card: Card, star: bool, starred: list[str], wide: float) -> list[Intent]:
    """Filled for a favourite; a click makes it one, or no longer."""
    path = str(card.path)
    imgui.push_style_color(imgui.Col_.button, (0, 0, 0, 0))
    imgui.push_style_color(imgui.Col_.text, ACCENT if star else imgui.get_style_color_vec4(imgui.Col_.text_disabled))
    imgui.push_style_var(imgui.StyleVar_.frame_border_size, 0.0)
    clicked = imgui.button(f"{icons.ICON_FA_STAR}###star {card.name}", (wide, 0))
    imgui.pop_style_var()
    imgui.pop_style_color(2)
    imgui.set_item_tooltip("No longer a favourite" if star else "Make it a favourite")
    kept = [other for other in starred if other != path] if star else [*starred, path]
    return [Prefer("favourites", kept)] if clicked else []
