"""Actions on the clay: shapes and strips added, taken away and set, and the tools to do it with."""

from __future__ import annotations

from dataclasses import replace
from functools import partial, reduce
from typing import TYPE_CHECKING

from hqmodel import edit
from hqmodel.edit.dimension import FLAT
from hqmodel.model import Scene, Strip

from ..editing import redo, undo
from ..intents import Choose, Edit, Equip, Select
from ..tools.kit import TOOLS
from ..tools.reach import MODAL
from .action import Action, always

if TYPE_CHECKING:
    from ..session import Session

PRISMS = (3, 5, 8)
AROUND = (3, 4, 5, 6, 8, 12)
_HELD = {"move": ("Move", "G"), "turn": ("Turn", "R"), "scale": ("Scale", "S"), "harden": ("Hardness", "H")}


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


def _add_prism(sides: int, session: Session) -> None:
    shape = edit.prism(sides)
    session.apply([Edit("Add prism", partial(edit.add_shape, shape=shape)), Select(len(session.scene.shapes))])


def _solid(session: Session) -> bool:
    return session.scene.dimension == 3


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


CLAY: dict[str, Action] = {
    "undo": Action("Undo", undo, ("Ctrl+Z",), lambda s: s.history.can_undo, None, lambda s: s.history.undo_label),
    "redo": Action("Redo", redo, ("Ctrl+Shift+Z", "Ctrl+Y"), lambda s: s.history.can_redo, None, lambda s: s.history.redo_label),
    "duplicate": Action("Duplicate", _duplicate, ("Ctrl+D",), _selected),
    "delete": Action("Delete", _delete, ("Del", "X"), _selected),
    "move up": Action("Move Up", partial(_move, -1), ("Ctrl+Up",), partial(_movable, -1)),
    "move down": Action("Move Down", partial(_move, 1), ("Ctrl+Down",), partial(_movable, 1)),
    **{f"add {kind}": Action(kind.capitalize(), partial(_add_shape, kind)) for kind in edit.PRIMITIVES},
    **{f"add prism {n}": Action(f"Prism of {n}", partial(_add_prism, n), (), _solid) for n in PRISMS},
    "add strip": Action("Strip", _add_strip, (), _selected),
    **{
        f"tool {name}": Action(tool.label, partial(_use, name), (tool.key,), always, partial(_in_hand, name))
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
}
