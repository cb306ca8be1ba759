"""Actions on what is seen: modes, views, sections, panels and the window's own looks."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from hqmodel.field import Plane, region
from hqmodel.model import VIEWS

from ..preferences import SIZES, STEPS, THEMES
from ..tools.arranging import AXES
from ..view import MODES
from .action import Action, always

if TYPE_CHECKING:
    from ..session import Session

PANELS = ("Outliner", "Presets", "Properties", "Scene", "Timeline", "Landscape")
# Not shown before they are asked for.
HIDDEN = ("Timeline", "Landscape")
_KEYS = {"front": "Num 1", "right": "Num 3", "top": "Num 7", "back": "Ctrl+Num 1", "left": "Ctrl+Num 3", "bottom": "Ctrl+Num 7"}


def _in_mode(mode: str, session: Session) -> bool:
    return session.view.mode == mode


def _set_mode(mode: str, session: Session) -> None:
    session.view = replace(session.view, mode=mode)


def _look(name: str, session: Session) -> None:
    session.look(session.view.camera.looking(name))


def _switch_projection(session: Session) -> None:
    camera = session.view.camera
    session.look(replace(camera, orthographic=not camera.orthographic))


def _section(axis: str, session: Session) -> None:
    """The body cut in its middle, across this axis, the half nearer to the eye gone; once more, whole again."""
    if _sectioned(axis, session):
        session.view = replace(session.view, cut=None)
        return
    x, y, z = AXES[axis]
    normal = (x, y, z) if session.view.camera.axes()[2] @ (x, y, z) >= 0 else (-x, -y, -z)
    session.view = replace(session.view, cut=Plane(normal, float(session.region.centre @ normal)))


def _sectioned(axis: str, session: Session) -> bool:
    return session.view.cut is not None and tuple(map(abs, session.view.cut.normal)) == AXES[axis]


def _switch_ghosts(session: Session) -> None:
    session.view = replace(session.view, ghosts=not session.view.ghosts)


def _flat(session: Session) -> bool:
    return session.scene.dimension == 2


def _switch_bands(session: Session) -> None:
    session.view = replace(session.view, bands=not session.view.bands)


def _switch_refining(session: Session) -> None:
    session.keep(session.settings.preferring(refining=not session.preferences.refining))


def _switch_frame_time(session: Session) -> None:
    session.keep(session.settings.preferring(frame_time=not session.preferences.frame_time))


def _switch_grid(session: Session) -> None:
    session.keep(session.settings.preferring(grid=not session.preferences.grid))


def _in_step(step: float | None, session: Session) -> bool:
    return session.preferences.grid_step == step


def _set_step(step: float | None, session: Session) -> None:
    session.keep(session.settings.preferring(grid_step=step))


def _frame_all(session: Session) -> None:
    session.frame(session.region)


def _frame_selected(session: Session) -> None:
    """The selected shapes by themselves, hidden or not; all where none is selected."""
    chosen = tuple(session.scene.shapes[index].changed(visible=True) for index in session.selection.shapes)
    alone = session.scene.changed(shapes=chosen, bounds=None) if chosen else session.scene
    box = region(alone)
    session.frame(session.region if box.empty or not box.bounded else box)


def _panel_shown(name: str, session: Session) -> bool:
    return name not in session.hidden_panels


def _toggle_panel(name: str, session: Session) -> None:
    session.hidden_panels ^= {name}


def _reset_layout(session: Session) -> None:
    session.hidden_panels = set(HIDDEN)
    session.layout_wanted = True


def _in_theme(name: str, session: Session) -> bool:
    return session.preferences.theme == name


def _set_theme(name: str, session: Session) -> None:
    session.keep(session.settings.preferring(theme=name))


def _in_size(percent: int, session: Session) -> bool:
    return session.preferences.percent == percent


def _set_size(percent: int, session: Session) -> None:
    session.keep(session.settings.preferring(percent=percent))


LOOKS: dict[str, Action] = {
    **{
        f"mode {mode}": Action(mode.capitalize(), partial(_set_mode, mode), (), always, partial(_in_mode, mode)) for mode in MODES
    },
    **{
        f"view {name}": Action(name.capitalize(), partial(_look, name), (_KEYS[name],) if name in _KEYS else ()) for name in VIEWS
    },
    "orthographic": Action("Orthographic", _switch_projection, ("Num 5",), always, lambda s: s.view.camera.orthographic),
    **{
        f"section {axis}": Action(f"Across {axis}", partial(_section, axis), (), always, partial(_sectioned, axis))
        for axis in AXES
    },
    "ghosts": Action("Carving Shapes as Ghosts", _switch_ghosts, (), always, lambda s: s.view.ghosts),
    "bands": Action("Bands", _switch_bands, (), _flat, lambda s: s.view.bands),
    "grid": Action("Grid Lines", _switch_grid, (), always, lambda s: s.preferences.grid),
    "grid auto": Action("Step That Fits", partial(_set_step, None), (), always, partial(_in_step, None)),
    **{
        f"grid {step:g}": Action(f"Step {step:g}", partial(_set_step, step), (), always, partial(_in_step, step))
        for step in STEPS
    },
    "frame time": Action("Frame Time", _switch_frame_time, (), always, lambda s: s.preferences.frame_time),
    "refine": Action("Refine at Rest", _switch_refining, (), always, lambda s: s.preferences.refining),
    "frame all": Action("Frame All", _frame_all, ("Home",)),
    "frame selected": Action("Frame Selected", _frame_selected, ("F", "Num .")),
    **{f"panel {name}": Action(name, partial(_toggle_panel, name), (), always, partial(_panel_shown, name)) for name in PANELS},
    "reset layout": Action("Reset the Layout", _reset_layout),
    **{
        f"theme {name}": Action(name.capitalize(), partial(_set_theme, name), (), always, partial(_in_theme, name))
        for name in THEMES
    },
    **{
        f"size {percent}": Action(f"{percent} %", partial(_set_size, percent), (), always, partial(_in_size, percent))
        for percent in SIZES
    },
}
