"""What a press takes hold of, with the tool in hand."""

from __future__ import annotations

import numpy as np

from hqmodel import edit
from hqmodel.field import Region, region
from hqmodel.model import Scene, Vector, vector

from ..selection import Selection
from .aim import Aim, Pixels
from .arranging import Move, Scale, Turn
from .gesture import Gesture
from .grip import Grip, outward
from .handles import Handles
from .kit import Kit
from .sculpting import Chop, Harden, Pat, Push, Soften

MODAL = ("move", "turn", "scale", "harden")


def taken(
    kit: Kit, scene: Scene, selection: Selection, aim: Aim, at: Pixels, grip: Grip | None, known: Handles | None
) -> Gesture | None:
    """The gesture that a drag from this pixel begins: with a handle, else with the plane that is under the pointer, if any.

    None where the drag is one of the view.
    """
    if kit.tool == "faces" and known is not None and (part := known.at(at)) is not None:
        return known.taken(part, scene, aim, at, kit.way)
    if kit.tool == "chop":
        return _chop(kit, scene, selection, aim, at)
    if grip is None:
        return None
    match kit.tool:
        case "faces":
            return Push(scene, aim, grip, kit.way)
        case "soften":
            return Soften(scene, aim, grip.shape, grip.strip)
        case "pat":
            return _pat(kit, scene, aim, grip)
    return None


def modal(name: str, scene: Scene, selection: Selection, aim: Aim, at: Pixels) -> Gesture | None:
    """The gesture that a key begins, without a button: one of `MODAL`, with the selected shapes; None where none is selected."""
    if selection.active is None:
        return None
    if name == "harden":
        return Harden(scene, aim, selection.active)
    kinds: dict[str, type[Move] | type[Turn] | type[Scale]] = {"move": Move, "turn": Turn, "scale": Scale}
    return kinds[name](scene, aim, selection.shapes, pivot(scene, selection.shapes), at)


def pivot(scene: Scene, shapes: tuple[int, ...]) -> Vector:
    """The middle of the shapes' own origins: what they are turned and scaled about."""
    return vector(np.mean([scene.shapes[index].transform.translation for index in shapes], axis=0))


def boxed(scene: Scene, aim: Aim, start: Pixels, end: Pixels) -> tuple[int, ...]:
    """The visible shapes whose middles are seen in the rectangle between two pixels."""
    low, high = np.minimum(start, end), np.maximum(start, end)
    middles = [_body(scene, (index,)).centre for index in range(len(scene.shapes))]
    seen = aim.pixel(np.array(middles).reshape(-1, 3))
    return tuple(
        index
        for index, shape in enumerate(scene.shapes)
        if shape.visible and bool(np.all(seen[index] >= low)) and bool(np.all(seen[index] <= high))
    )


def _pat(kit: Kit, scene: Scene, aim: Aim, grip: Grip) -> Gesture:
    shape, image = edit.clay_at(scene, grip.point)
    return Pat(scene, aim, shape, grip.point, vector(outward(scene, grip.point)), vector(image), kit.pat)


def _chop(kit: Kit, scene: Scene, selection: Selection, aim: Aim, at: Pixels) -> Gesture | None:
    """The selected shapes, or all where none is; those that carve are no clay."""
    clay = [index for index, shape in enumerate(scene.shapes) if shape.visible and shape.coefficient > 0]
    shapes = tuple(index for index in clay if index in selection.shapes) or tuple(clay)
    return Chop(scene, aim, shapes, at, _body(scene, shapes), kit.chop) if shapes else None


def _body(scene: Scene, shapes: tuple[int, ...]) -> Region:
    """Where these shapes are by themselves."""
    chosen = tuple(
        scene.shapes[index].changed(visible=True, coefficient=abs(scene.shapes[index].coefficient)) for index in shapes
    )
    return region(scene.changed(shapes=chosen))
