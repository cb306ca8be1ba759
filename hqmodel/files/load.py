"""Preset files, or bytes of them, to scenes, with precise errors."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from hqmodel.model import MAX_SHAPES, MAX_STRIPS, Scene, faults, place, shown

from .builtin import find_builtin, similar
from .errors import PresetError
from .migrate import migrated, unreadable
from .strict import MAX_BYTES, read_object


def load(preset: str | os.PathLike[str]) -> Scene:
    """The scene of a preset file, or of the built-in preset of that name.

    Raises PresetError.
    """
    return parse(_read(find(preset)), os.fspath(preset))


def parse(data: bytes, source: str) -> Scene:
    """The scene that the bytes of a preset file describe; `source` is what errors call it.

    Raises PresetError.
    """
    tree = read_object(data, source)
    reason = unreadable(tree)
    if reason:
        raise PresetError(source, [reason])
    tree = migrated(tree)
    excess = list(_excess(tree))
    if excess:
        raise PresetError(source, excess)
    try:
        return Scene.model_validate(tree)
    except ValidationError as error:
        raise PresetError(source, faults(error)) from None


def find(preset: str | os.PathLike[str]) -> Path:
    """The file that is meant by a path or by a built-in preset's name; a file of that name comes first.

    Raises PresetError, with names that come close, when there is neither.
    """
    name = os.fspath(preset)
    mode = _mode(name)
    if mode and not stat.S_ISDIR(mode):
        return Path(name)
    named = find_builtin(name)
    if named is not None:
        return named.path
    expected = "a file" if _is_path(name) else "a preset file or a built-in preset's name"
    got = "a folder" if mode else "nothing of that name"
    close = similar(Path(name).stem)
    hint = f" (built in: {', '.join(close)})" if close else ""
    raise PresetError(name or "''", [f"expected {expected}, got {got}{hint}"])


def _mode(name: str) -> int:
    """The type and permissions of what lies at a path; 0 where nothing does or can."""
    try:
        return Path(name).stat().st_mode if name else 0
    except (OSError, ValueError):
        return 0


def _is_path(name: str) -> bool:
    return name.endswith(".json") or any(mark in name for mark in ("/", os.sep))


def _read(path: Path) -> bytes:
    """The file's bytes, or one more than are permitted."""
    try:
        with path.open("rb") as stream:
            return stream.read(MAX_BYTES + 1)
    except OSError as error:
        raise PresetError(str(path), [f"expected a file that can be read, got: {error.strerror}"]) from None


def _excess(tree: dict[str, Any]) -> Iterator[str]:
    """Lists so long that validating every item would be a waste, or worse: each is a fault by itself."""
    shapes = tree.get("shapes")
    if isinstance(shapes, list):
        if len(shapes) > MAX_SHAPES:
            yield f"shapes: expected at most {MAX_SHAPES} shapes, got {len(shapes)}"
        else:
            yield from _crowded(shapes)
    animations = tree.get("animations")
    if isinstance(animations, list):
        wrong = next(((i, item) for i, item in enumerate(animations) if not isinstance(item, dict)), None)
        if wrong:
            yield f"animations[{wrong[0]}]: expected an object, got {shown(wrong[1])}"


def _crowded(shapes: list[Any]) -> Iterator[str]:
    total = 0
    for index, shape in enumerate(shapes):
        if not isinstance(shape, dict):
            continue
        strips, groups, mirror = shape.get("strips"), shape.get("groups"), shape.get("mirror")
        total += len(strips) if isinstance(strips, list) else 0
        if isinstance(groups, dict) and len(groups) > MAX_STRIPS:
            yield f"{place(('shapes', index, 'groups'))}: expected at most {MAX_STRIPS} groups, got {len(groups)}"
        if isinstance(mirror, list) and len(mirror) > 3:
            yield f"{place(('shapes', index, 'mirror'))}: expected each axis once, got a list of {len(mirror)}"
    if total > MAX_STRIPS:
        yield f"shapes: expected at most {MAX_STRIPS} strips in all, got {total}"
