"""Comma-separated tables of numbers, a block of rows at a time: in with exact complaints, out with every digit."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, islice
from math import isfinite
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hqmodel.model import shown

from .faults import Fault
from .options import NUMBER

Array = NDArray[np.float64]

BLOCK = 1 << 15
_LONGEST_HEADER = 1 << 16


@dataclass(frozen=True, eq=False)
class Rows:
    """Some rows of a table: `values` (n, columns), the file's `lines` they stand on, and the share of the file read so far."""

    values: Array
    lines: list[int]
    share: float


@dataclass(frozen=True)
class _Header:
    width: int
    chosen: tuple[int, ...]
    columns: tuple[str, ...]


def rows(path: Path, columns: Sequence[str]) -> Iterator[Rows]:
    """The named columns of a table whose first line names them, in any order; other columns and blank lines are passed over.

    Raises Fault, naming the line, for whatever is not a table of finite numbers.
    """
    try:
        with path.open("rb") as raw:
            size = max(1, os.fstat(raw.fileno()).st_size)
            text = io.TextIOWrapper(raw, encoding="utf-8-sig", errors="replace")
            header = _header(path, text.readline(_LONGEST_HEADER), columns)
            done, read = 1, 0
            while block := list(islice(text, BLOCK)):
                filled = [(number, line) for number, line in enumerate(block, done + 1) if not line.isspace()]
                done, read = done + len(block), read + sum(map(len, block))
                if filled:
                    yield Rows(_numbers(path, header, filled), [number for number, _ in filled], min(1.0, read / size))
    except OSError as error:
        raise Fault(f"{path}: expected a file that can be read, got: {error.strerror or error}") from None


def text_of(values: Array) -> bytes:
    """Rows of numbers as lines of a table: the shortest digits that give the same number back, and an empty cell for NaN."""
    line = ",".join(["%r"] * values.shape[1]) + "\n"
    text = (line * len(values)) % tuple(chain.from_iterable(values.tolist()))
    return (text.replace("nan", "") if np.isnan(values).any() else text).encode()


def header_of(columns: Sequence[str]) -> bytes:
    """The first line of a table."""
    return (",".join(columns) + "\n").encode()


def _header(path: Path, line: str, columns: Sequence[str]) -> _Header:
    names = [cell.strip().lower() for cell in _cells(line)]
    if any(names.count(column) != 1 for column in columns):
        got = shown(line.strip()) if line.strip() else "an empty line"
        raise Fault(f"{path}: line 1: expected the columns {','.join(columns)}, got {got}")
    return _Header(len(names), tuple(names.index(column) for column in columns), tuple(columns))


def _numbers(path: Path, header: _Header, filled: list[tuple[int, str]]) -> Array:
    """The chosen columns of some lines, all at once; where that fails, line by line to find out why."""
    lines = [line for _, line in filled]
    if all(line.count(",") == header.width - 1 for line in lines):
        try:
            values = np.loadtxt(lines, delimiter=",", usecols=header.chosen, comments=None, ndmin=2)
        except ValueError:
            return _one_by_one(path, header, filled)
        if bool(np.isfinite(values).all()):
            return values
    return _one_by_one(path, header, filled)


def _one_by_one(path: Path, header: _Header, filled: list[tuple[int, str]]) -> Array:
    """The same by Python's csv module, which knows quoted cells; the first wrong cell is named."""
    values = np.empty((len(filled), len(header.chosen)))
    for row, (number, line) in enumerate(filled):
        cells = _cells(line)
        if len(cells) != header.width:
            raise Fault(f"{path}: line {number}: expected {header.width} cells, got {len(cells)}")
        for column, (index, name) in enumerate(zip(header.chosen, header.columns, strict=True)):
            text = cells[index].strip()
            if not NUMBER.fullmatch(text) or not isfinite(float(text)):
                got = shown(text) if text else "an empty cell"
                raise Fault(f"{path}: line {number}, column {name}: expected a finite number, got {got}")
            values[row, column] = float(text)
    return values


def _cells(line: str) -> list[str]:
    try:
        return next(csv.reader([line]), [])
    except csv.Error:  # a cell of more than 128 KiB, which is no number
        return []
