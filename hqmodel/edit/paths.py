"""Any value of a scene by its path, ``shapes[0].strips[1].gamma``: read it, or put another in its place in a new scene."""

from __future__ import annotations

import re
from ast import literal_eval
from collections.abc import Iterable
from typing import Any

from pydantic import ValidationError

from hqmodel.model import Scene, Shape, Strip, faults, place, shown
from hqmodel.model.scene import Value

Location = tuple[str | int, ...]

_STEP = re.compile(r"""(?:^|\.)(?P<word>\w+)|\[(?P<index>\d{1,9})\]|\[(?P<text>'(?:[^'\\]|\\.)*'|"(?:[^"\\]|\\.)*")\]""")


class EditError(ValueError):
    """An edit that cannot be made; the message is one line, ``PLACE: expected what, got what``."""


def parse(path: str) -> Location:
    """The steps of a path: ``shapes[0].groups['my rim'].gamma`` is ``('shapes', 0, 'groups', 'my rim', 'gamma')``.

    Raises EditError when the text is no path.
    """
    steps: list[str | int] = []
    at = 0
    while at < len(path):
        match = _STEP.match(path, at)
        if match is None or (at == 0 and match["word"] is None):
            raise EditError(f"{_name(path)}: expected a path such as shapes[0].strips[1].gamma, got {shown(path[at:])}")
        steps.append(match["word"] or (int(match["index"]) if match["index"] else _unquoted(path, match["text"])))
        at = match.end()
    if not steps:
        raise EditError("expected a path such as shapes[0].strips[1].gamma, got nothing")
    return tuple(steps)


def locations(scene: Scene, path: str | Location) -> list[Location]:
    """Every place that a path means in this scene, each of them there.

    A path that begins with a field of strips (``gamma``, ``normal[2]``) means every strip's, one that begins with a field of
    shapes (``hardness``, ``transform.scale[0]``) every shape's; what the scene itself has (``slice``, ``name``) comes first.
    Raises EditError where the scene has no such place.
    """
    steps = parse(path) if isinstance(path, str) else tuple(path)
    if steps[0] in Scene.model_fields:
        found = [steps]
    elif steps[0] in Strip.model_fields:
        found = [("shapes", i, "strips", j, *steps) for i, s in enumerate(scene.shapes) for j in range(len(s.strips))]
    elif steps[0] in Shape.model_fields:
        found = [("shapes", i, *steps) for i in range(len(scene.shapes))]
    else:
        raise EditError(f"{place(steps)}: expected a field of the scene, its shapes or strips, got {shown(steps[0])}")
    if not found:
        raise EditError(f"{place(steps)}: expected a scene with shapes, got none")
    for location in found:
        _value_at(scene, location)
    return found


def get(scene: Scene, path: str | Location) -> Any:
    """The value at a path; of a path that means several places, the first one's.

    Raises EditError where the scene has no such place.
    """
    return _value_at(scene, locations(scene, path)[0])


def put(scene: Scene, path: str | Location, value: object) -> Scene:
    """The scene with another value at a path, or at all the places that the path means.

    The exponent that a group's strips share changes for all of them. Raises EditError where the scene has no such place or
    the value is not permitted there.
    """
    changed: Any = scene
    for location in locations(scene, path):
        for one in _sharing(scene, location):
            changed = _with(changed, one, value)
    try:
        return Scene.model_validate(changed)
    except ValidationError as error:
        raise EditError(faults(error)[0]) from None


def put_fields(scene: Scene, path: str | Location, **changes: object) -> Scene:
    """The scene with some fields of the value at a path changed. Raises EditError as `put` does."""
    value = get(scene, path)
    return put(scene, path, {**value.__dict__, **(value.model_extra or {}), **changes})


def reset(scene: Scene, path: str | Location) -> Scene:
    """The scene with the format's default at a path; EditError where there is no default."""
    for location in locations(scene, path):
        scene = put(scene, location, _default(scene, location))
    return scene


def _name(path: str) -> str:
    return path if path.isprintable() and len(path) <= 80 else shown(path)


def _unquoted(path: str, text: str) -> str:
    try:
        return str(literal_eval(text))
    except (SyntaxError, ValueError):
        raise EditError(f"{_name(path)}: expected a quoted name, got {shown(text)}") from None


def _value_at(scene: Scene, location: Location) -> Any:
    value: Any = scene
    for depth, step in enumerate(location):
        value = _part(value, location[:depth], step)
    return value


def _part(value: Any, where: Location, step: str | int) -> Any:
    """The part of a value that one more step leads to."""
    wanted = place((*where, step))
    if isinstance(value, Value):
        if step in type(value).model_fields:
            return getattr(value, str(step))
        raise EditError(f"{wanted}: expected {_either(type(value).model_fields)}, got {shown(step)}")
    if isinstance(value, (tuple, list)):
        if isinstance(step, int) and step < len(value):
            return value[step]
        expected = f"an index from 0 to {len(value) - 1}" if value else "a list with something in it"
        raise EditError(f"{wanted}: expected {expected}, got {shown(step)}")
    if isinstance(value, dict):
        if step in value:
            return value[step]
        raise EditError(f"{wanted}: expected {_either(value) if value else 'a name that is there (none is)'}, got {shown(step)}")
    raise EditError(f"{place(where)}: has no parts, got {shown(step)}")


def _either(choices: Iterable[str]) -> str:
    names = [name if name.isidentifier() else shown(name, 40) for name in choices]
    return " or ".join(filter(None, [", ".join(names[:-1]), names[-1]]))


def _sharing(scene: Scene, location: Location) -> list[Location]:
    """The place itself, or for the exponent of a strip in a group that of each strip of the group."""
    if len(location) != 5 or location[2] != "strips" or location[4] != "gamma":
        return [location]
    strips = scene.shapes[int(location[1])].strips
    group = strips[int(location[3])].group
    if group is None:
        return [location]
    return [(*location[:3], index, "gamma") for index, strip in enumerate(strips) if strip.group == group]


def _with(value: Any, location: Location, new: object) -> Any:
    """The value as plain data along the location, with the new part at its end; all else stays the very same objects."""
    if not location:
        return new
    step, *rest = location
    if isinstance(value, (tuple, list)):
        items = list(value)
        items[int(step)] = _with(items[int(step)], tuple(rest), new)
        return items
    fields = {**value.__dict__, **(value.model_extra or {})} if isinstance(value, Value) else dict(value)
    fields[str(step)] = _with(fields[str(step)], tuple(rest), new)
    return fields


def _default(scene: Scene, location: Location) -> Any:
    """What the format has at a place when a preset says nothing."""
    depth = next(d for d in reversed(range(len(location))) if isinstance(_value_at(scene, location[:d]), Value))
    owner, name = _value_at(scene, location[:depth]), str(location[depth])
    field = type(owner).model_fields[name]
    if field.is_required():
        raise EditError(f"{place(location)}: has no default")
    default = field.get_default(call_default_factory=True)
    for step in location[depth + 1 :]:
        default = _part(default, location[: depth + 1], step)
    return default
