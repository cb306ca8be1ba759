"""Where the panels are docked at first, and which of them are shown."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

from imgui_bundle import hello_imgui, imgui

from hqmodel.files import settings_folder

from .actions import HIDDEN
from .session import Session

# Panel: the space it is docked in. Each space is split off another one: side, share.
_PLACES = {
    "Viewport": "MainDockSpace",
    "Outliner": "LeftSpace",
    "Presets": "LeftLowerSpace",
    "Properties": "RightSpace",
    "Scene": "RightSpace",
    "Timeline": "LowerSpace",
    "Landscape": "RightLowerSpace",
}
_SPLITS = (
    ("MainDockSpace", "LeftSpace", imgui.Dir.left, 0.2),
    ("MainDockSpace", "RightSpace", imgui.Dir.right, 0.34),
    ("LeftSpace", "LeftLowerSpace", imgui.Dir.down, 0.55),
    ("MainDockSpace", "LowerSpace", imgui.Dir.down, 0.42),
    ("RightSpace", "RightLowerSpace", imgui.Dir.down, 0.5),
)
_PLAIN = imgui.internal.DockNodeFlagsPrivate_.no_window_menu_button | imgui.internal.DockNodeFlagsPrivate_.no_close_button
_FIXED = imgui.WindowFlags_.no_scrollbar | imgui.WindowFlags_.no_scroll_with_mouse | imgui.WindowFlags_.no_move
_BARE = imgui.internal.DockNodeFlagsPrivate_.no_tab_bar


def kept_in() -> Path | None:
    """The file where hello_imgui keeps the layout; None in a home that can't be written to: it is not kept then, that is all."""
    folder = settings_folder()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return None
    return folder / "window.ini" if os.access(folder, os.W_OK) else None


def docking(panels: Mapping[str, Callable[[], None]]) -> hello_imgui.DockingParams:
    """The default layout; what the user makes of it is kept by hello_imgui."""
    splits = [hello_imgui.DockingSplit(*split, _PLAIN) for split in _SPLITS]
    params = hello_imgui.DockingParams(splits, [_window(name, draw) for name, draw in panels.items()])
    params.main_dock_space_node_flags |= _PLAIN
    return params


def _window(name: str, draw: Callable[[], None]) -> hello_imgui.DockableWindow:
    if name != "Viewport":
        return hello_imgui.DockableWindow(name, _PLACES[name], draw, is_visible_=name not in HIDDEN)
    window = hello_imgui.DockableWindow(name, _PLACES[name], partial(_bare, name, draw), can_be_closed_=False)
    window.call_begin_end = False
    return window


def _bare(name: str, draw: Callable[[], None]) -> None:
    """A window that is all content: without a tab, a cross or a margin."""
    kind = imgui.WindowClass()
    kind.dock_node_flags_override_set = _BARE
    imgui.set_next_window_class(kind)
    imgui.push_style_var(imgui.StyleVar_.window_padding, (0.0, 0.0))
    shown, _ = imgui.begin(name, None, _FIXED)
    imgui.pop_style_var()
    if shown:
        draw()
    imgui.end()


class Shown:
    """Which panels are shown: the session's word, and what came of their crosses and of the last time."""

    def __init__(self) -> None:
        self._before: dict[str, bool] = {}

    def sync(self, params: hello_imgui.RunnerParams, session: Session) -> None:
        """Whichever of the two has changed since the last frame is what the other is made."""
        for window in params.docking_params.dockable_windows:
            if self._before.get(window.label) != window.is_visible:
                (session.hidden_panels.discard if window.is_visible else session.hidden_panels.add)(window.label)
            window.is_visible = self._before[window.label] = window.label not in session.hidden_panels
        if session.layout_wanted:
            params.docking_params.layout_reset, session.layout_wanted = True, False
