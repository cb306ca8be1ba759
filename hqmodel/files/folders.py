"""Many files that are there all together or not at all."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryDirectory


@contextmanager
def filling(folder: Path) -> Iterator[Path]:
    """An empty folder to write many files in, which move into `folder`, made where it isn't there, when the block ends well.

    Raises OSError.
    """
    new = not folder.exists()
    try:
        folder.mkdir(exist_ok=True)
        with TemporaryDirectory(prefix=".hqmodel-", suffix=".tmp", dir=folder) as draft:
            yield Path(draft)
            new = False
            for path in sorted(Path(draft).rglob("*")):
                target = folder / path.relative_to(draft)
                if path.is_dir():
                    target.mkdir(exist_ok=True)
                else:
                    path.replace(target)
    finally:
        if new:
            with suppress(OSError):
                folder.rmdir()
