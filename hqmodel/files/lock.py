"""A lock that ends with its process, whatever ends that."""

from __future__ import annotations

import os
import sys
from errno import ENOENT
from pathlib import Path

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl


class Lock:
    """Holds a lock file, which is made where there is none, until it is let go. Raises OSError where another one holds it."""

    def __init__(self, path: Path) -> None:
        self._descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)
        try:
            if sys.platform == "win32":
                msvcrt.locking(self._descriptor, msvcrt.LK_NBLCK, 1)
            else:
                fcntl.flock(self._descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if not os.path.samestat(os.fstat(self._descriptor), path.stat()):  # removed since by who held it before
                raise FileNotFoundError(ENOENT, os.strerror(ENOENT), str(path))
        except OSError:
            os.close(self._descriptor)
            raise

    def release(self) -> None:
        """Let it go; the file stays."""
        os.close(self._descriptor)
