"""The one table of actions: what menus, shortcuts and the list of shortcuts are made of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial, reduce
from typing import TYPE_CHECKING

from hqmodel import edit, files
from hqmodel.edit.dimension import FLAT
from hqmodel.field import Plane, region
from hqmodel.model import VIEWS, Scene, Strip

from .asks import About, ChooseFile, ExportAs, ExportSettings, New, Palette, Problem, Quit, Shortcuts, Tour
from .catalogue import catalogue
from .forecast import Forecast
from .intents import Choose, Edit, Equip, Select
from .tools.arranging import AXES
from .tools.kit import TOOLS
from .tools.reach import MODAL
from .view import MODES

if TYPE_CHECKING:
    from .session import Session

THEMES = ("dark", "light")
# Of everything in the window, in hundredths of its usual size.
SIZES = (80, 90, 100, 110, 125, 150, 175, 200)
PANELS = ("Outliner", "Presets", "Properties", "Scene", "Timeline", "Landscape")
# Not shown before they are asked for.
HIDDEN = ("Timeline", "Landscape")


def _always(_: Session) -> bool:
    return True


def _nothing(_: Session) -> str:
    return ""


@dataclass(frozen=True)
class Action:
    """One thing that can be done. `shortcuts` are written as people write them, Ctrl+Shift+S; the menu shows the first.

    `detail` is added to the label: what would be undone, for one.
    """

    label: str
    run: Callable[[Session], None]
    shortcuts: tuple[str, ...] = ()
    enabled: Callable[[Session], bool] = _always
    checked: Callable[[Session], bool] | None = None
    detail: Callable[[Session], str] = _nothing

    def title(self, session: Session) -> str:
        detail = self.detail(session)
        return f"{self.label} {detail}" if detail else self.label


def perform(session: Session, name: str) -> None:
    """Do the action of that name, unless it can't be done now."""
    action = ACTIONS[name]
    if action.enabled(session):
        action.run(session)


# File


def _save(session: Session) -> None:
    session.release()
    session.save(session.document.path)


def _open(session: Session) -> None:
    session.dialogs.append(ChooseFile("open", session.folder))


def _save_as(session: Session) -> None:
    session.release()
    session.save(None)


def _has_versions(session: Session) -> bool:
    path = session.document.path
    return path is not None and files.backup_folder(path).is_dir()


def _versions(session: Session) -> None:
    if session.document.path is not None:
        session.dialogs.append(ChooseFile("open", files.backup_folder(session.document.path)))


def _import(session: Session) -> None:
    from hqmodel.fit import FORMATS  # late: it takes a second, and few need it

    session.dialogs.append(ChooseFile("import", session.folder, endings=FORMATS))


def _show_cloud(session: Session) -> None:
    session.cloud_hidden = not session.cloud_hidden


def _working(session: Session) -> bool:
    return session.job is not None


def _stop_export(session: Session) -> None:
    if session.job is not None:
        session.job.cancel()


def _export(session: Session) -> None:
    session.release()
    if session.region.empty or not session.region.bounded:
        reason = "there is no body to export" if session.region.empty else UNBOUNDED
        session.dialogs.append(Problem("Nothing to export", (reason,)))
        return
    path = session.folder / session.document.file_name
    told = Forecast(session.scene, session.wake).told
    session.dialogs.append(ExportAs(ExportSettings(path.with_suffix(".glb")), told))


UNBOUNDED = "The body runs on without end: give it bounds in the Scene panel, the box that it is cut by."


# Edit


def _selected(session: Session) -> bool:
    return bool(session.selection.shapes)


def _add_shape(kind: str, session: Session) -> None:
    shape = edit.new_shape(kind, session.scene.dimension)
    session.apply([Edit(f"Add {kind}", partial(edit.add_shape, shape=shape)), Select(len(session.scene.shapes))])


def _add_strip(session: Session) -> None:
    """A strip across the diagonal, where it bites into most shapes and so can be seen."""
    shape = session.selection.active
    if shape is not None:
        strip = Strip(normal=(0.7, 0.7, 0.0), gamma=FLAT)
        count = len(session.scene.shapes[shape].strips)
        session.apply([Edit("Add strip", partial(edit.add_strip, shape=shape, strip=strip)), Select(shape, count)])


def _duplicate(session: Session) -> None:
    shape, strip = session.selection.active, session.selection.strip
    if shape is not None and strip is not None:
        session.apply(
            [Edit("Duplicate strip", partial(edit.duplicate_strip, shape=shape, index=strip)), Select(shape, strip + 1)]
        )
    elif shape is not None:
        chosen = sorted(session.selection.shapes, reverse=True)
        session.apply([Edit("Duplicate", lambda scene: reduce(edit.duplicate_shape, chosen, scene)), Select(shape + 1)])


def _delete(session: Session) -> None:
    shape, strip = session.selection.active, session.selection.strip
    if shape is not None and strip is not None:
        session.apply([Edit("Delete strip", partial(edit.remove_strip, shape=shape, index=strip)), Select(shape)])
    else:
        session.apply([Edit("Delete", partial(edit.remove_shapes, indices=session.selection.shapes)), Select(None)])


def _movable(by: int, session: Session) -> bool:
    shape, strip = session.selection.active, session.selection.strip
    if shape is None:
        return False
    if strip is None:
        return 0 <= shape + by < len(session.scene.shapes)
    return 0 <= strip + by < len(session.scene.shapes[shape].strips)


def _move(by: int, session: Session) -> None:
    shape, strip = session.selection.active, session.selection.strip
    if shape is None:
        return
    if strip is None:
        session.apply([Edit("Reorder", partial(edit.move_shape, index=shape, to=shape + by)), Select(shape + by)])
    else:
        change = partial(edit.move_strip, shape=shape, index=strip, to=strip + by)
        session.apply([Edit("Reorder", change), Select(shape, strip + by)])


# The clay


def _use(tool: str, session: Session) -> None:
    session.apply([Equip(replace(session.kit, tool=tool))])


def _in_hand(tool: str, session: Session) -> bool:
    return session.kit.tool == tool


def _begin(gesture: str, session: Session) -> None:
    """The viewport knows where the pointer is: it takes hold in its next frame."""
    session.wanted_gesture = gesture


def _exponents(label: str, factor: float, session: Session) -> None:
    """The selected strip's, or those of all selected shapes."""
    selection = session.selection
    chosen = None if selection.strip is None else [selection.strip]
    shapes = selection.shapes if chosen is None else selection.shapes[-1:]

    def change(scene: Scene) -> Scene:
        return reduce(lambda scene, shape: edit.scale_exponents(scene, shape, factor, chosen), shapes, scene)

    session.apply([Edit(label, change)])


def _carve(session: Session) -> None:
    shapes = session.selection.shapes
    carving = session.scene.shapes[shapes[-1]].coefficient > 0
    session.apply([Edit("Carve" if carving else "Add", partial(edit.carve, indices=shapes, carving=carving))])


def _carving(session: Session) -> bool:
    active = session.selection.active
    return active is not None and session.scene.shapes[active].coefficient < 0


def _solo(session: Session) -> None:
    """Only the selected shapes are seen; once more, all are."""
    chosen = session.selection.shapes
    alone = all(shape.visible == (index in chosen) for index, shape in enumerate(session.scene.shapes))

    def change(scene: Scene) -> Scene:
        for index in range(len(scene.shapes)):
            scene = edit.put(scene, ("shapes", index, "visible"), alone or index in chosen)
        return scene

    session.apply([Edit("Solo" if not alone else "Show all", change)])


def _radial(count: int, session: Session) -> None:
    active = session.selection.active
    if active is not None:
        session.apply([Edit(f"{count} around", partial(edit.repeat_around, index=active, axis=(0, 0, 1), count=count))])


def _select_all(session: Session) -> None:
    session.apply([Choose(tuple(range(len(session.scene.shapes))))])


def _deselect(session: Session) -> None:
    session.apply([Select(None)])


def _add_prism(sides: int, session: Session) -> None:
    shape = edit.prism(sides)
    session.apply([Edit("Add prism", partial(edit.add_shape, shape=shape)), Select(len(session.scene.shapes))])


def _solid(session: Session) -> bool:
    return session.scene.dimension == 3


# View


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


def _refining(session: Session) -> bool:
    return session.refining


def _switch_refining(session: Session) -> None:
    session.keep(session.settings.preferring(refining=not session.refining))


def _switch_frame_time(session: Session) -> None:
    session.keep(session.settings.preferring(frame_time=not session.frame_time))


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
    return session.theme == name


def _set_theme(name: str, session: Session) -> None:
    session.keep(session.settings.preferring(theme=name))


# Help


def _palette(session: Session) -> None:
    session.release()
    session.dialogs.append(Palette(catalogue(session, ACTIONS, MENUS)))


def _in_size(percent: int, session: Session) -> bool:
    return session.percent == percent


def _set_size(percent: int, session: Session) -> None:
    session.keep(session.settings.preferring(percent=percent))


_KEYS = {"front": "Num 1", "right": "Num 3", "top": "Num 7", "back": "Ctrl+Num 1", "left": "Ctrl+Num 3", "bottom": "Ctrl+Num 7"}

_HELD = {"move": ("Move", "G"), "turn": ("Turn", "R"), "scale": ("Scale", "S"), "harden": ("Hardness", "H")}
PRISMS = (3, 5, 8)
AROUND = (3, 4, 5, 6, 8, 12)

ACTIONS: dict[str, Action] = {
    "new": Action("New", lambda s: s.leave(New()), ("Ctrl+N",)),
    "open": Action("Open...", _open, ("Ctrl+O",)),
    "save": Action("Save", _save, ("Ctrl+S",)),
    "save as": Action("Save As...", _save_as, ("Ctrl+Shift+S",)),
    "versions": Action("Earlier Versions...", _versions, (), _has_versions),
    "export": Action("Export...", _export, ("Ctrl+E",), lambda s: s.job is None),
    "import": Action("Import and Fit...", _import, ("Ctrl+I",), lambda s: s.job is None),
    "stop export": Action("Stop What Is Under Way", _stop_export, (), _working),
    "cloud": Action("Imported Points", _show_cloud, (), lambda s: s.cloud is not None, lambda s: not s.cloud_hidden),
    "quit": Action("Quit", lambda s: s.leave(Quit()), ("Ctrl+Q",)),
    "undo": Action("Undo", lambda s: s.undo(), ("Ctrl+Z",), lambda s: s.history.can_undo, None, lambda s: s.history.undo_label),
    "redo": Action(
        "Redo", lambda s: s.redo(), ("Ctrl+Shift+Z", "Ctrl+Y"), lambda s: s.history.can_redo, None, lambda s: s.history.redo_label
    ),
    "duplicate": Action("Duplicate", _duplicate, ("Ctrl+D",), _selected),
    "delete": Action("Delete", _delete, ("Del", "X"), _selected),
    "move up": Action("Move Up", partial(_move, -1), ("Ctrl+Up",), partial(_movable, -1)),
    "move down": Action("Move Down", partial(_move, 1), ("Ctrl+Down",), partial(_movable, 1)),
    **{f"add {kind}": Action(kind.capitalize(), partial(_add_shape, kind)) for kind in edit.PRIMITIVES},
    **{f"add prism {n}": Action(f"Prism of {n}", partial(_add_prism, n), (), _solid) for n in PRISMS},
    "add strip": Action("Strip", _add_strip, (), _selected),
    **{
        f"tool {name}": Action(tool.label, partial(_use, name), (tool.key,), _always, partial(_in_hand, name))
        for name, tool in TOOLS.items()
    },
    **{f"hold {name}": Action(_HELD[name][0], partial(_begin, name), (_HELD[name][1],), _selected) for name in MODAL},
    "rounder": Action("Rounder", partial(_exponents, "Rounder", 0.8), ("[",), _selected),
    "sharper": Action("Sharper", partial(_exponents, "Sharper", 1.25), ("]",), _selected),
    "pinch": Action("Pinch", partial(_exponents, "Pinch", 0.4), (), _selected),
    "carve": Action("Carve with It", _carve, ("Ctrl+Minus",), _selected, _carving),
    "solo": Action("Solo", _solo, ("Num /",), _selected),
    **{f"around {n}": Action(f"{n} Around z", partial(_radial, n), (), _selected) for n in AROUND},
    "select all": Action("Select All", _select_all, ("A",)),
    "select none": Action("Select None", _deselect, ("Alt+A",)),
    **{
        f"mode {mode}": Action(mode.capitalize(), partial(_set_mode, mode), (), _always, partial(_in_mode, mode))
        for mode in MODES
    },
    **{
        f"view {name}": Action(name.capitalize(), partial(_look, name), (_KEYS[name],) if name in _KEYS else ()) for name in VIEWS
    },
    "orthographic": Action("Orthographic", _switch_projection, ("Num 5",), _always, lambda s: s.view.camera.orthographic),
    **{
        f"section {axis}": Action(f"Across {axis}", partial(_section, axis), (), _always, partial(_sectioned, axis))
        for axis in AXES
    },
    "ghosts": Action("Carving Shapes as Ghosts", _switch_ghosts, (), _always, lambda s: s.view.ghosts),
    "bands": Action("Bands", _switch_bands, (), _flat, lambda s: s.view.bands),
    "frame time": Action("Frame Time", _switch_frame_time, (), _always, lambda s: s.frame_time),
    "refine": Action("Refine at Rest", _switch_refining, (), _always, _refining),
    "frame all": Action("Frame All", _frame_all, ("Home",)),
    "frame selected": Action("Frame Selected", _frame_selected, ("F", "Num .")),
    **{f"panel {name}": Action(name, partial(_toggle_panel, name), (), _always, partial(_panel_shown, name)) for name in PANELS},
    "reset layout": Action("Reset the Layout", _reset_layout),
    **{
        f"theme {name}": Action(name.capitalize(), partial(_set_theme, name), (), _always, partial(_in_theme, name))
        for name in THEMES
    },
    **{
        f"size {percent}": Action(f"{percent} %", partial(_set_size, percent), (), _always, partial(_in_size, percent))
        for percent in SIZES
    },
    "palette": Action("Find a Command...", _palette, ("Ctrl+P",)),
    "shortcuts": Action("Shortcuts", lambda s: s.dialogs.append(Shortcuts(catalogue(s, ACTIONS, MENUS))), ("F1",)),
    "tour": Action("Tour", lambda s: s.dialogs.append(Tour())),
    "about": Action("About", lambda s: s.dialogs.append(About())),
}

Entry = str | None | tuple[str, tuple[str, ...]]
RECENT = "recent"

# The menu bar: names of actions, None for a line between, a pair for a menu within; RECENT stands for the recent files.
MENUS: dict[str, tuple[Entry, ...]] = {
    "File": ("new", "open", RECENT, None, "save", "save as", "versions", None, "import", "export", "stop export", None, "quit"),
    "Edit": ("undo", "redo", None, "select all", "select none", None, "duplicate", "delete", "move up", "move down"),
    "Add": (*(f"add {kind}" for kind in edit.PRIMITIVES), *(f"add prism {n}" for n in PRISMS), None, "add strip"),
    "Shape": (
        *(f"hold {name}" for name in MODAL),
        None,
        "rounder",
        "sharper",
        "pinch",
        None,
        "carve",
        "solo",
        ("Copies Around z", tuple(f"around {n}" for n in AROUND)),
    ),
    "Tools": tuple(f"tool {name}" for name in TOOLS),
    "View": (
        *(f"mode {mode}" for mode in MODES),
        None,
        ("Section", tuple(f"section {axis}" for axis in AXES)),
        "ghosts",
        "bands",
        "cloud",
        "refine",
        "frame time",
        None,
        "frame all",
        "frame selected",
        ("Look From", tuple(f"view {name}" for name in VIEWS)),
        "orthographic",
        None,
        ("Panels", (*(f"panel {name}" for name in PANELS), "reset layout")),
        ("Theme", tuple(f"theme {name}" for name in THEMES)),
        ("Size", tuple(f"size {percent}" for percent in SIZES)),
    ),
    "Help": ("palette", "shortcuts", "tour", None, "about"),
}
