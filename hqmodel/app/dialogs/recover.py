"""Work that a window left which did not end as it should: go on with it, or throw it away."""

from __future__ import annotations

from pathlib import Path

from imgui_bundle import imgui

from hqmodel.files import Lost

from ..asks import Dialog, Recover, Recovered
from ..intents import Answer, Intent
from ..recovery import said
from .buttons import buttons

_TABLE = imgui.TableFlags_.sizing_fixed_fit | imgui.TableFlags_.row_bg | imgui.TableFlags_.pad_outer_x


def draw(dialog: Dialog) -> list[Intent]:
    """A row for each, the latest first; nothing is lost by asking again next time."""
    assert isinstance(dialog, Recover)
    imgui.text_unformatted("hqmodel did not end as it should. This was not saved:")
    imgui.spacing()
    intents: list[Intent] = []
    if imgui.begin_table("lost", 3, _TABLE):
        for number, lost in enumerate(dialog.lost):
            imgui.table_next_row()
            imgui.push_id(number)
            intents += _row(lost)
            imgui.pop_id()
        imgui.end_table()
    return intents or ([Answer()] if buttons(["Ask Again Next Time"]) else [])


def _row(lost: Lost) -> list[Intent]:
    imgui.table_next_column()
    imgui.align_text_to_frame_padding()
    imgui.text_unformatted(lost.origin.name)
    imgui.set_item_tooltip(str(Path(lost.origin.path)) if lost.origin.path else "Never saved")
    imgui.table_next_column()
    imgui.text_disabled(said(lost.time))
    imgui.table_next_column()
    opened = imgui.button("Open")
    imgui.same_line()
    discarded = imgui.button("Discard")
    return [Answer(Recovered(lost, wanted=opened))] if opened or discarded else []
