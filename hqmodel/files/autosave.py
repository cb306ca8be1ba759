"""Copies of work that is not saved: a few files a window, offered again when the window that wrote them is gone.

Each window has a folder of its own, beside it a lock that the system lets go when the window ends, however it ends::

    autosave/5f0c9a1e.lock
    autosave/5f0c9a1e/origin.json    whose work it is: the document's name, its file, and what that file held
    autosave/5f0c9a1e/000007.json    the copies, presets like any other; the highest number is the latest

A folder whose lock can be taken is the work of a window that did not end as it should.
"""

from __future__ import annotations

import json
import shutil
from dataclasses import asdict, dataclass
from pathlib import Path
from secrets import token_hex

from hqmodel.model import Scene

from .atomic import atomic
from .dump import save
from .lock import Lock
from .settings import state_folder

# As many copies are kept of a document: should the last one be damaged, there are others.
COPIES = 3


@dataclass(frozen=True)
class Origin:
    """The document that a copy is of: its name, its file if it has one, and the fingerprint of what it read there."""

    name: str
    path: str | None = None
    fingerprint: str | None = None


class Ring:
    """The copies of one window. Nothing is on the disk until there is something to keep."""

    def __init__(self) -> None:
        self._folder = state_folder() / "autosave" / token_hex(8)
        self._lock: Lock | None = None
        self._origin: Origin | None = None
        self._number = 0

    def keep(self, scene: Scene, origin: Origin) -> Path:
        """Write one more copy, whole or not at all, and drop the oldest; those of another document all go. Its file.

        Raises OSError, and PresetError for a scene too large for a preset.
        """
        if self._lock is None:
            self._folder.parent.mkdir(parents=True, exist_ok=True)
            self._lock = Lock(_lock_of(self._folder))
        if origin != self._origin:
            self._begin(origin)
        self._number += 1
        path = self._folder / f"{self._number:06}.json"
        save(scene, path)
        for old in _copies(self._folder)[COPIES:]:
            old.unlink()
        return path

    def clear(self) -> None:
        """There is nothing to keep now: all of it goes from the disk."""
        if self._lock is not None:
            _remove(self._folder, self._lock)
            self._lock = self._origin = None

    def abandon(self) -> None:
        """Leave the copies to be found."""
        if self._lock is not None:
            self._lock.release()
            self._lock = None

    def _begin(self, origin: Origin) -> None:
        self._folder.mkdir(exist_ok=True)
        for copy in _copies(self._folder):
            copy.unlink()
        with atomic(self._folder / "origin.json") as stream:
            stream.write(json.dumps(asdict(origin)).encode())
        self._origin = origin


class Lost:
    """What a window left that is gone. It is ours, and nobody else is offered it, until it is let go or discarded."""

    def __init__(self, folder: Path, lock: Lock) -> None:
        self._folder = folder
        self._lock = lock
        self.copies = _copies(folder)
        self.origin = _origin(folder)

    @property
    def time(self) -> float:
        """When the latest copy was written, in seconds since 1970."""
        return self.copies[0].stat().st_mtime

    def release(self) -> None:
        """Leave it to be found again."""
        self._lock.release()

    def discard(self) -> None:
        """Remove it for good."""
        _remove(self._folder, self._lock)


def lost() -> list[Lost]:
    """All that windows left that are gone, the latest first; each is held until it is let go or discarded."""
    found = []
    for lock_file in (state_folder() / "autosave").glob("*.lock"):
        folder = lock_file.with_suffix("")
        try:
            lock = Lock(lock_file)
        except OSError:
            continue  # its window runs
        if _copies(folder):
            found.append(Lost(folder, lock))
        else:
            _remove(folder, lock)
    return sorted(found, key=lambda one: one.time, reverse=True)


def _lock_of(folder: Path) -> Path:
    return folder.with_suffix(".lock")


def _copies(folder: Path) -> list[Path]:
    """The copies in a folder, the latest first."""
    return sorted(folder.glob("[0-9]*.json"), reverse=True)


def _origin(folder: Path) -> Origin:
    """Whose copies these are; where that can't be read, somebody's."""
    try:
        return Origin(**json.loads((folder / "origin.json").read_bytes()))
    except (OSError, ValueError, TypeError, RecursionError):
        return Origin("Untitled")


def _remove(folder: Path, lock: Lock) -> None:
    """The folder first: as long as it is there, its lock is held."""
    shutil.rmtree(folder, ignore_errors=True)
    lock.release()
    _lock_of(folder).unlink(missing_ok=True)
