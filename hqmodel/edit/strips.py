"""Strips added, removed, copied and grouped: pure functions from a scene to a new one.

Each raises `EditError` with one line when an index is not there or the result would not be a valid scene.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Literal

from hqmodel.model import Group, Scene, Shape, Strip, place, unused_name

from .paths import EditError, get, put_fields


def add_strip(scene: Scene, shape: int, strip: Strip) -> Scene:
    """The strip appended to the shape of that index."""
    return _with_strips(scene, shape, (*_shape(scene, shape).strips, strip))


def remove_strip(scene: Scene, shape: int, index: int) -> Scene:
    """The shape without that strip; the last one of a group takes the group along."""
    get(scene, ("shapes", shape, "strips", index))
    strips = _shape(scene, shape).strips
    return _with_strips(scene, shape, (*strips[:index], *strips[index + 1 :]))


def duplicate_strip(scene: Scene, shape: int, index: int) -> Scene:
    """A copy of the strip right after it, in the same group."""
    strip = get(scene, ("shapes", shape, "strips", index))
    strips = _shape(scene, shape).strips
    return _with_strips(scene, shape, (*strips[: index + 1], strip, *strips[index + 1 :]))


def move_strip(scene: Scene, shape: int, index: int, to: int) -> Scene:
    """The strip taken out and put in again so that its index is `to`."""
    strip = get(scene, ("shapes", shape, "strips", index))
    get(scene, ("shapes", shape, "strips", to))
    strips = _shape(scene, shape).strips
    rest = [*strips[:index], *strips[index + 1 :]]
    return _with_strips(scene, shape, (*rest[:to], strip, *rest[to:]))


def set_group(scene: Scene, shape: int, indices: Sequence[int], name: str | None = None) -> Scene:
    """These strips joined to the group of that name; a new one where there is none (eqs. 7, 14).

    All take the inner exponent that the group has, or else the first of them; it is a new group's outer exponent too, so that
    strips that already share their exponent and sign keep their shape. Without a name one is found.
    """
    old = _shape(scene, shape)
    chosen = [get(scene, ("shapes", shape, "strips", index)) for index in indices]
    if not chosen:
        raise EditError(f"{place(('shapes', shape, 'strips'))}: expected strips to group, got none")
    name = unused_name("group", old.groups) if name is None else name
    signs = {_sign(old, strip) for strip in chosen}
    if len(signs) > 1:
        raise EditError(f"{place(('shapes', shape, 'strips', indices[0], 'sign'))}: expected strips of one sign, got both")
    members = [strip for strip in old.strips if strip.group == name]
    gamma = (members or chosen)[0].gamma
    groups = {name: Group(gamma=gamma, sign=signs.pop()), **old.groups}
    strips = list(old.strips)
    for index in indices:
        strips[index] = strips[index].changed(group=name, gamma=gamma, sign=1)
    return _with_strips(scene, shape, strips, groups)


def ungroup(scene: Scene, shape: int, indices: Collection[int]) -> Scene:
    """These strips on their own again: each keeps its inner exponent and takes the group's sign."""
    old = _shape(scene, shape)
    strips = list(old.strips)
    for index in indices:
        strip = get(scene, ("shapes", shape, "strips", index))
        strips[index] = strip.changed(group=None, sign=_sign(old, strip))
    return _with_strips(scene, shape, strips)


def _shape(scene: Scene, index: int) -> Shape:
    found: Shape = get(scene, ("shapes", index))
    return found


def _sign(shape: Shape, strip: Strip) -> Literal[1, -1]:
    return strip.sign if strip.group is None else shape.groups[strip.group].sign


def _with_strips(scene: Scene, index: int, strips: Sequence[Strip], groups: dict[str, Group] | None = None) -> Scene:
    """The scene with other strips in one shape, and of its groups those that still have strips or never had any."""
    old = _shape(scene, index)
    left = {strip.group for strip in old.strips} - {strip.group for strip in strips}
    kept = {name: group for name, group in (groups or old.groups).items() if name not in left}
    return put_fields(scene, ("shapes", index), strips=tuple(strips), groups=kept)
