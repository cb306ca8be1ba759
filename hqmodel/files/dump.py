"""Scenes to preset files: the format's keys in its order, unknown ones after them, one strip a line."""

from __future__ import annotations

import json
import os
from typing import Any

from hqmodel.model import Group, Scene, Strip
from hqmodel.model.scene import Value

from .atomic import atomic
from .errors import PresetError
from .strict import MAX_BYTES

_WIDTH = 160


def dumps(scene: Scene) -> str:
    """The text of the scene's preset file; reading it back gives an equal scene, and writing that again the same text."""
    return _written(plain(scene), 0, whole=True) + "\n"


def save(scene: Scene, path: str | os.PathLike[str]) -> None:
    """Write the scene's preset file; whatever happens, the file is the old one or the new one, whole.

    Raises OSError, and PresetError for a scene whose unknown keys make it larger than a preset may be.
    """
    data = dumps(scene).encode()
    if len(data) > MAX_BYTES:
        data = _line(plain(scene), (",", ":")).encode()
    if len(data) > MAX_BYTES:
        raise PresetError(os.fspath(path), [f"expected a preset of at most {MAX_BYTES >> 20} MiB, got {len(data)} bytes"])
    with atomic(path) as stream:
        stream.write(data)


def plain(scene: Scene) -> dict[str, Any]:
    """The scene as the plain data that its file holds."""
    tree: dict[str, Any] = _plain(scene)
    if scene.dimension == 2:
        for shape in tree["shapes"]:
            for strip in shape["strips"]:
                strip["normal"] = strip["normal"][:2]
    return tree


def _plain(value: Any) -> Any:
    if isinstance(value, Value):
        known = {name: _plain(getattr(value, name)) for name in type(value).model_fields if _worth_saying(value, name)}
        return {**known, **(value.model_extra or {})}
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    return [_plain(item) for item in value] if isinstance(value, tuple) else value


def _worth_saying(value: Value, name: str) -> bool:
    """Strips and groups, of which there are many, leave out what is at its default, but never an exponent."""
    if getattr(value, name) is None:
        return False
    field = type(value).model_fields[name]
    return not isinstance(value, (Strip, Group)) or name == "gamma" or getattr(value, name) != field.default


def _written(value: Any, indent: int, whole: bool = False) -> str:
    """JSON text: lists of objects, and objects that don't fit a line, have one item a line; `whole` never is on one line."""
    if not isinstance(value, (dict, list)) or not value:
        return _line(value)
    if not whole and not _holds_objects(value):
        line = _line(value)
        if isinstance(value, list) or len(line) + indent <= _WIDTH:
            return line
    margin = " " * (indent + 2)
    if isinstance(value, dict):
        keys = [_line(key) for key in value]
        parts = [f"{key}: {_written(item, indent + 2)}" for key, item in zip(keys, value.values(), strict=True)]
    else:
        parts = [_written(item, indent + 2) for item in value]
    opening, closing = ("{", "}") if isinstance(value, dict) else ("[", "]")
    return f"{opening}\n{margin}" + f",\n{margin}".join(parts) + f"\n{' ' * indent}{closing}"


def _line(value: Any, separators: tuple[str, str] = (", ", ": ")) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=separators)


def _holds_objects(value: Any) -> bool:
    """Whether there is a list of objects anywhere inside."""
    if isinstance(value, dict):
        return any(_holds_objects(item) for item in value.values())
    return isinstance(value, list) and any(isinstance(item, dict) or _holds_objects(item) for item in value)
