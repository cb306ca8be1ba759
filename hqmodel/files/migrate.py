"""Presets of older versions of the format made into the newest, one version at a time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from hqmodel.model import FORMAT, VERSION, shown

Tree = dict[str, Any]

# From each older version to the next: takes the preset as plain data, returns it as the next version has it. Unknown keys
# are to be carried along. Format 1 is the first.
MIGRATIONS: Mapping[int, Callable[[Tree], Tree]] = {}


def unreadable(tree: Tree, newest: int = VERSION) -> str | None:
    """Why this object is not a preset that this program can read, as one line; None when it is one."""
    if "format" not in tree:
        return f'format: required, but missing (a preset says "format": "{FORMAT}")'
    if tree["format"] != FORMAT:
        return f'format: expected "{FORMAT}", got {shown(tree["format"])}'
    if "version" not in tree:
        return f'version: required, but missing (the newest is "version": {newest})'
    version = tree["version"]
    if isinstance(version, bool) or not isinstance(version, (int, float)) or version != int(version) or version < 1:
        return f"version: expected a whole number from 1 to {newest}, got {shown(version)}"
    if version > newest:
        return f"version: expected at most {newest}, got {shown(version)}: a newer hqmodel saved this preset, update to open it"
    return None


def migrated(tree: Tree, migrations: Mapping[int, Callable[[Tree], Tree]] = MIGRATIONS, newest: int = VERSION) -> Tree:
    """A readable preset's plain data as the newest version has it."""
    for version in range(int(tree["version"]), newest):
        tree = {**migrations[version](tree), "version": version + 1}
    return tree
