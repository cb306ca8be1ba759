"""Earlier versions of the files that were saved over, in the program's own folder."""

from __future__ import annotations

import os
import shutil
from hashlib import sha256
from pathlib import Path
from time import strftime

from .atomic import atomic
from .settings import state_folder

# So many versions are kept of a file, and of so many files.
VERSIONS = 10
FILES = 100


def fingerprint(path: str | os.PathLike[str]) -> str | None:
    """What tells the file's present bytes from all others; None where there are none that can be read."""
    try:
        return sha256(Path(path).read_bytes()).hexdigest()
    except OSError:
        return None


def backup_folder(path: str | os.PathLike[str]) -> Path:
    """Where the earlier versions of this file are; it need not exist. A link and the file it leads to are one."""
    real = os.path.realpath(path)
    return _shelf() / f"{Path(real).stem}-{sha256(os.fsencode(real)).hexdigest()[:8]}"


def back_up(path: str | os.PathLike[str]) -> bool:
    """Keep what the file holds now, unless it is kept already; False where the system does not let us."""
    if not Path(path).is_file():
        return True
    folder = backup_folder(path)
    try:
        before = Path(path).read_bytes()
        kept = _latest_first(folder)
        if kept and kept[0].read_bytes() == before:
            return True
        folder.mkdir(parents=True, exist_ok=True)
        with atomic(_free(folder)) as stream:
            stream.write(before)
        _prune(folder)
    except OSError:
        return False
    return True


def _shelf() -> Path:
    return state_folder() / "backups"


def _free(folder: Path) -> Path:
    """A name that says when; several in one second are numbered."""
    when = strftime("%Y-%m-%d %H.%M.%S")
    paths = (folder / f"{when}{f' ({number})' if number else ''}.json" for number in range(VERSIONS + 2))
    return next(path for path in paths if not path.exists())


def _latest_first(folder: Path) -> list[Path]:
    return sorted(folder.glob("*.json"), key=lambda path: path.stat().st_mtime_ns, reverse=True)


def _prune(folder: Path) -> None:
    for path in _latest_first(folder)[VERSIONS:]:
        path.unlink()
    folders = sorted(_shelf().iterdir(), key=lambda path: path.stat().st_mtime_ns, reverse=True)
    for forgotten in folders[FILES:]:
        shutil.rmtree(forgotten, ignore_errors=True)
