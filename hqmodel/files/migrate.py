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
    if tree.get("format") != FORMAT:
        return f'format: expected "{FORMAT}", got {_got(tree, "format")}'
    version = tree.get("version")
    if isinstance(version, bool) or not isinstance(version, (int, float)) or version != int(version) or version < 1:
        expected = "1" if newest == 1 else f"a whole number from 1 to {newest}"
        return f"version: expected {expected}, got {_got(tree, 'version')}"
    if version > newest:
        return f"version: expected at most {newest}, got {shown(version)}: a newer hqmodel saved this preset, update to open it"
    return None


def _got(tree: Tree, key: str) -> str:
    return shown(tree[key]) if key in tree else "nothing"


def migrated(tree: Tree, migrations: Mapping[int, Callable[[Tree], Tree]] = MIGRATIONS, newest: int = VERSION) -> Tree:
    """A readable preset's plain data as the newest version has it."""
    for version in range(int(tree["version"]), newest):
        tree = {**migrations[version](tree), "version": version + 1}
    return tree
