"""Files that are there whole or not at all."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from errno import EACCES, EISDIR
from pathlib import Path
from secrets import token_hex
from typing import BinaryIO

# Links followed one by one, looking for /dev/stdout and its like.
_LINKS = 8
# A draft that was last written so many seconds before another is nobody's any more.
_FORSAKEN = 3600.0


@contextmanager
def atomic(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """A binary stream that becomes the file `path` when the block ends well, and nothing when it does not.

    After a crash at any moment the file is the old one or the new one, whole: the new one is written beside it, forced to the
    disk and moved over it; what a crash leaves beside it a later call removes. A link is followed and stays; the permissions
    (and the owner, where one may) stay as they were. A device, a pipe or what this process has open already (/dev/stdout) is
    written to directly. Raises OSError.
    """
    descriptor = _descriptor(path)
    if descriptor is not None:
        with os.fdopen(os.dup(descriptor), "wb") as stream:
            yield stream
        return
    try:
        old = Path(path).stat()
    except FileNotFoundError:
        old = None
    if old is not None and not stat.S_ISREG(old.st_mode):
        with _special(path, old) as stream:
            yield stream
        return
    target = Path(os.path.realpath(path))
    if old is not None and not os.access(target, os.W_OK):
        raise PermissionError(EACCES, os.strerror(EACCES), os.fspath(path))
    draft = target.parent / f".hqmodel-{token_hex(8)}.tmp"
    try:
        with _created(draft, path) as stream:
            yield stream
            stream.flush()
            if old is not None:
                _keep(stream.fileno(), draft, old)
            os.fsync(stream.fileno())
        draft.replace(target)
    except BaseException:
        draft.unlink(missing_ok=True)
        raise
    _sync_folder(target.parent)
    _sweep(target)


def _descriptor(path: str | os.PathLike[str]) -> int | None:
    """The number of the open file that a path such as /dev/stdout or /dev/fd/3 stands for; None for any other path."""
    here = Path(path)
    for _ in range(_LINKS):
        folder = here.parent.resolve()
        if here.name.isdecimal() and str(folder) in ("/dev/fd", f"/proc/{os.getpid()}/fd"):
            return int(here.name)
        if not here.is_symlink():
            break
        here = folder / here.readlink()
    return None


def _special(path: str | os.PathLike[str], status: os.stat_result) -> BinaryIO:
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError(EISDIR, os.strerror(EISDIR), os.fspath(path))
    return Path(path).open("wb")


def _created(draft: Path, wanted: str | os.PathLike[str]) -> BinaryIO:
    """The draft, new, with the permissions that any new file gets; an error names the file that was wanted."""
    try:
        return draft.open("xb")
    except OSError as error:
        raise type(error)(error.errno, error.strerror, os.fspath(wanted)) from None


def _keep(descriptor: int, draft: Path, old: os.stat_result) -> None:
    """Give the new file the old one's owner, where that is permitted, and its permissions."""
    if hasattr(os, "fchown"):
        with suppress(PermissionError):
            os.fchown(descriptor, old.st_uid, old.st_gid)
    draft.chmod(stat.S_IMODE(old.st_mode))


def _sync_folder(path: Path) -> None:
    """Force the move itself to the disk; systems on which folders can't be opened do it by themselves."""
    if os.name != "posix":
        return
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _sweep(written: Path) -> None:
    """Remove the drafts that crashes left beside a file just written, by the clock of the disk they are on."""
    with suppress(OSError):
        now = written.stat().st_mtime
        for draft in written.parent.glob(".hqmodel-*.tmp"):
            if draft.is_file() and now - draft.stat().st_mtime > _FORSAKEN:
                draft.unlink()
