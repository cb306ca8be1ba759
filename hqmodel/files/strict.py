"""Bytes to plain data by strict JSON: what Python's reader lets pass and a preset may not hold is an error here.

Limits hold before memory is spent: on size before parsing, on depth and numbers before anything is made of them.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from math import isfinite
from typing import Any

from hqmodel.model import place, shown

from .errors import PresetError

MAX_BYTES = 4 << 20
MAX_DEPTH = 64
# Longer whole numbers are read as floats, and so turn out infinite instead of costing quadratic time.
_MAX_DIGITS = 300

Location = tuple[str | int, ...]


def read_object(data: bytes, source: str) -> dict[str, Any]:
    """The object that a preset file holds at its top.

    Raises PresetError, with a line and a column where the text is no JSON.
    """
    if len(data) > MAX_BYTES:
        raise PresetError(source, [f"expected a file of at most {MAX_BYTES >> 20} MiB, got a larger one"])
    text = _decoded(data, source)
    if not text.strip():
        raise PresetError(source, ["expected a preset, got an empty file"])
    tree = _parsed(text, source)
    if not isinstance(tree, dict):
        raise PresetError(source, [f"expected an object at the top, got {'a list' if isinstance(tree, list) else shown(tree)}"])
    problems = list(_faults(tree))
    if problems:
        raise PresetError(source, problems)
    return tree


class _Repeating(dict[str, Any]):
    """An object in which a key came twice."""

    repeated = ""


def _decoded(data: bytes, source: str) -> str:
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        wrong = data[error.start : error.start + 1].hex()
        raise PresetError(source, [f"byte {error.start}: expected text in UTF-8, got 0x{wrong}"]) from None


def _parsed(text: str, source: str) -> Any:
    try:
        return json.loads(text, parse_int=_whole, parse_constant=float, object_pairs_hook=_object)
    except json.JSONDecodeError as error:
        got = shown(text[error.pos : error.pos + 20]) if error.pos < len(text) else "the end of the file"
        where = f"line {error.lineno}, column {error.colno}"
        raise PresetError(source, [f"{where}: expected valid JSON, got {got} ({error.msg})"]) from None
    except RecursionError:
        raise PresetError(source, [f"expected at most {MAX_DEPTH} levels of nesting, got more"]) from None


def _whole(digits: str) -> int | float:
    return int(digits) if len(digits) <= _MAX_DIGITS else float(digits)


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    result = dict(pairs)
    if len(result) == len(pairs):  # nearly always
        return result
    seen: set[str] = set()
    marked = _Repeating(result)
    marked.repeated = next(key for key, _ in pairs if key in seen or seen.add(key))  # type: ignore[func-returns-value]
    return marked


def _faults(tree: dict[str, Any]) -> Iterator[str]:
    """What a strict reader would not have taken, one line each, in the file's order."""
    waiting: list[tuple[Location, Any]] = [((), tree)]
    while waiting:
        where, value = waiting.pop()
        if len(where) > MAX_DEPTH:
            yield f"{place(where[:3])}: expected at most {MAX_DEPTH} levels of nesting, got more"
            return
        if isinstance(value, _Repeating):
            yield f"{place((*where, value.repeated))}: expected each key once, got it twice"
        items = value.items() if isinstance(value, dict) else enumerate(value)
        inner = []
        for step, item in items:
            if isinstance(item, (dict, list)):
                if item:
                    inner.append(((*where, step), item))
            elif fault := _leaf_fault(item):
                yield f"{place((*where, step))}: {fault}"
            if isinstance(step, str) and not _is_unicode(step):
                yield f"{place(where) or 'top'}: expected keys of Unicode text, got {shown(step)}"
        waiting.extend(reversed(inner))


def _leaf_fault(value: Any) -> str | None:
    if isinstance(value, float) and not isfinite(value):
        return f"expected a finite number, got {value}"
    if isinstance(value, str) and not _is_unicode(value):
        return f"expected Unicode text, got {shown(value)}"
    return None


def _is_unicode(text: str) -> bool:
    """Whether the text can be written as UTF-8: JSON's escapes can spell half a surrogate pair."""
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True
