"""From pydantic's errors to one clear line each: ``shapes[0].strips[2].gamma: expected ..., got ...``."""

from __future__ import annotations

from typing import Any

from pydantic import ValidationError

from .fields import FIELDS, pattern, place, shown

_KINDS = {
    "string": "text",
    "bool": "true or false",
    "dict": "an object",
    "model": "an object",
    "tuple": "a list",
    "list": "a list",
    "missing": "a list",  # of shapes or strips, without which there is no preset
}


def faults(error: ValidationError) -> list[str]:
    """One line for each thing wrong, `PLACE: expected what, got what`, in the order they were found."""
    return list(dict.fromkeys(_line(item) for item in error.errors(include_url=False)))


def _line(item: Any) -> str:
    context = item.get("ctx", {})
    location = tuple(item["loc"]) + tuple(context.get("where", ()))
    if item["type"] == "missing" and location and isinstance(location[-1], int):  # a vector that is too short
        location, item = location[:-1], {**item, "type": "too_short"}
    where = place(location)
    return f"{where}: {_wrong(item, location, context)}" if where else _wrong(item, location, context)


def _wrong(item: Any, location: tuple[str | int, ...], context: dict[str, Any]) -> str:
    kind = item["type"]
    if kind == "hqmodel":
        return str(item["msg"])
    got = "nothing" if kind == "missing" else shown(item["input"])
    return f"expected {_expected(kind, location, context)}, got {got}"


def _expected(kind: str, location: tuple[str | int, ...], context: dict[str, Any]) -> str:
    number = FIELDS.get(pattern(location))
    if number is not None:
        return number.expected()
    vector = FIELDS.get(pattern(location) + "[]")
    if vector is not None:
        return f"a list of {len(vector.parts)} numbers"
    corners = FIELDS.get(pattern(location) + "[][]")
    if corners is not None:
        return f"two lists of {len(corners.parts)} numbers"
    if kind == "literal_error":
        return str(context["expected"]).replace("'", '"')
    if kind == "too_long":
        return f"a list of at most {context['max_length']}"
    if kind.startswith(("float", "int", "finite")):
        return "a finite number"
    return _KINDS.get(kind.split("_")[0], kind.replace("_", " "))
