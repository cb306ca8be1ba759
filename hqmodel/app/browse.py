"""What a file dialog of our own lists."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Listing:
    """Names in a folder, in order; `problem` says why there are none."""

    folders: tuple[str, ...] = ()
    files: tuple[str, ...] = ()
    problem: str = ""


def listing(folder: Path, endings: Collection[str]) -> Listing:
    """The folders in a folder, and its files with one of the endings; hidden ones left out."""
    folders, files = [], []
    try:
        for entry in sorted(folder.iterdir(), key=lambda path: path.name.casefold()):
            if entry.name.startswith("."):
                continue
            if entry.is_dir():
                folders.append(entry.name)
            elif entry.suffix.lower() in endings:
                files.append(entry.name)
    except OSError as error:
        return Listing(problem=f"{folder}: {error.strerror}")
    return Listing(tuple(folders), tuple(files))
