"""Beside the picture: the plane of a section view to slide, and the numbers that colours of curvature stand for."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from hqmodel.field import Plane
from hqmodel.gpu import Legend

from ..intents import Intent, See
from ..session import Session
from .overlay import Pen

# The scale's width and height, and how far it stays from the viewport's edges, in heights of the font.
_WIDE, _HIGH, _INSET = 0.9, 12.0, 1.2


def scale(pen: Pen, legend: Legend, size: tuple[int, int]) -> None:
    """The colours of the curvature mode as a bar with its numbers, at the right."""
    right, bottom = size[0] - _INSET * pen.em, size[1] - 2 * _INSET * pen.em
    left, top = right - _WIDE * pen.em, bottom - _HIGH * pen.em
    heights = np.linspace(bottom, top, len(legend.colors))
    for (low, high), (below, above) in zip(pairwise(heights), pairwise(legend.colors), strict=True):
        pen.shaded((left, high), (right, low), above, below)
    for share, text in legend.ticks():
        pen.text((left - 0.6 * pen.em - imgui.calc_text_size(text).x, bottom - share * (bottom - top) - pen.em / 2), text)
    pen.text((right - imgui.calc_text_size("K").x, top - 1.8 * pen.em), "K")


def section(session: Session, corner: imgui.ImVec2, size: tuple[int, int]) -> list[Intent]:
    """A slider for the plane of the section view, a button for its other side, and one to end it; nothing without a section."""
    cut = session.view.cut
    if cut is None:
        return []
    em, box = imgui.get_font_size(), session.shown_region
    ends = np.array([box.low, box.high]) * cut.normal
    low, high = float(ends.sum(axis=1).min()), float(ends.sum(axis=1).max())
    imgui.set_cursor_screen_pos((corner.x + 3.4 * em, corner.y + size[1] - 2.4 * em))
    imgui.set_next_item_width(min(16 * em, 0.5 * size[0]))
    changed, offset = imgui.slider_float("##section", cut.offset, low, high, f"section {_axis(cut)} = %.3f")
    after = replace(cut, offset=offset) if changed else cut
    imgui.same_line()
    if imgui.button(f"{icons.ICON_FA_REPEAT}##other side"):
        after = Plane((-cut.normal[0], -cut.normal[1], -cut.normal[2]), -cut.offset)
    imgui.set_item_tooltip("Show the other side")
    imgui.same_line()
    ended = imgui.button(f"{icons.ICON_FA_XMARK}##no section")
    imgui.set_item_tooltip("End the section view")
    if ended:
        return [See(replace(session.view, cut=None))]
    return [See(replace(session.view, cut=after))] if after != cut else []


def _axis(cut: Plane) -> str:
    """Which axis the plane lies across, with a minus where it is seen from below."""
    axis = int(np.argmax(np.abs(cut.normal)))
    return ("-" if cut.normal[axis] < 0 else "") + "xyz"[axis]
