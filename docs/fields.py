"""The table of numbers in ``format.md``, from the one table of editable fields: ``python -m docs.fields`` puts it there."""

from __future__ import annotations

from pathlib import Path

from hqmodel.model import FIELDS, Number

PAGE = Path(__file__).parent / "format.md"
_HEAD = ("| place | default | what it is |", "| --- | --- | --- |")


def table() -> str:
    """Markdown; each number's place in a preset, its default, its range and its help."""
    return "\n".join([*_HEAD, *(_row(place, spec) for place, spec in FIELDS.items())])


def _row(place: str, spec: Number) -> str:
    default = "required" if spec.default is None and place.endswith(("normal[]", "gamma")) else spec.default
    shown = "none" if default is None else list(default) if isinstance(default, tuple) else default
    said = f"**{spec.label}.** {spec.help}"
    limits = "" if spec.expected() == "a finite number" else f" {spec.expected().capitalize()}."
    return f"| `{place}` | {shown} | {said}{limits} |"


def main() -> None:
    """Replace the table in the page."""
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    start = lines.index(_HEAD[0])
    end = next(number for number in range(start, len(lines)) if not lines[number].startswith("|"))
    PAGE.write_text("\n".join([*lines[:start], table(), *lines[end:]]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
