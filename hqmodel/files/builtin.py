"""The presets that come with the program, found by name."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

from hqmodel.resources import folder


@dataclass(frozen=True)
class Builtin:
    """A built-in preset: `name` is its file's, `title` and `description` what its scene says, `collection` its folder."""

    name: str
    path: Path
    title: str
    description: str
    collection: str


def builtin() -> list[Builtin]:
    """Every built-in preset, by collection and name."""
    return [_described(path) for path in sorted(folder("presets").glob("*/*.json"))]


def find_builtin(name: str) -> Builtin | None:
    """The built-in preset of that name or title, upper and lower case, blanks and dashes being all one; None without one."""
    wanted = _plain(name)
    return next((preset for preset in builtin() if wanted and wanted in (_plain(preset.name), _plain(preset.title))), None)


def similar(name: str) -> list[str]:
    """Names of up to three built-in presets that somebody may have meant."""
    names = {_plain(text): preset.name for preset in reversed(builtin()) for text in (preset.title, preset.name)}
    close = get_close_matches(_plain(name), names, n=6, cutoff=0.55)
    return list(dict.fromkeys(names[text] for text in close))[:3]


def _plain(name: str) -> str:
    return re.sub(r"[\s_-]+", " ", name.removesuffix(".json")).strip().casefold()


def _described(path: Path) -> Builtin:
    tree = json.loads(path.read_bytes())
    return Builtin(path.stem, path, tree.get("name") or path.stem, tree.get("description", ""), path.parent.name)
