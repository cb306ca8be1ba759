"""Output files, all of them there whole or none; and what is told of a run that went well."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from math import isfinite
from pathlib import Path
from typing import Any, BinaryIO

from hqmodel import files

from .faults import USAGE, Fault, unwritable


def checked(paths: Sequence[Path], endings: Collection[str], inputs: Sequence[str] = ()) -> None:
    """Refuse, before any work is done, output files of the wrong kind, in no folder, named twice, or that are the input.

    Raises Fault.
    """
    for path in paths:
        if endings and path.suffix.lower() not in endings:
            got = path.suffix or "no ending"
            raise Fault(f"{path}: expected a file name that ends in {' or '.join(endings)}, got {got}", USAGE)
        if not path.parent.is_dir():
            raise Fault(f"{path}: expected a file in a folder that exists, got {path.parent}", USAGE)
        if any(_same(path, Path(name)) for name in inputs):
            raise Fault(f"{path}: expected another file than the preset, got the same", USAGE)
    if len({path.resolve() for path in paths}) < len(paths):
        raise Fault(f"-o: expected each file once, got {', '.join(map(str, paths))}", USAGE)


@contextmanager
def writing(paths: Sequence[Path]) -> Iterator[list[BinaryIO]]:
    """A stream for each file; the files appear when the block ends well, and none does when it doesn't.

    Raises Fault when one can't be written.
    """
    names = ", ".join(map(str, paths))
    try:
        with ExitStack() as stack:
            yield [stack.enter_context(files.atomic(path)) for path in paths]
    except OSError as error:
        raise unwritable(error.filename or names, error) from None


@contextmanager
def filling(folder: Path) -> Iterator[Path]:
    """`files.filling`; raises Fault when a file can't be written."""
    try:
        with files.filling(folder) as draft:
            yield draft
    except OSError as error:
        raise unwritable(error.filename or folder, error) from None


def tell(result: dict[str, Any], text: str, as_json: bool, quiet: bool) -> None:
    """Print what came of a command: the JSON object, or the text for people, or nothing."""
    if as_json:
        print(json.dumps(_finite(result), allow_nan=False))
    elif text and not quiet:
        print(text)


def _same(path: Path, other: Path) -> bool:
    return path.exists() and other.exists() and path.samefile(other)


def _finite(value: Any) -> Any:
    """JSON has no NaN and no infinity: null stands for them."""
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not isfinite(value) else value
