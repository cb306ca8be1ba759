"""What a preset file can be told to be at fault for."""

from __future__ import annotations

from collections.abc import Sequence

LISTED = 20


class PresetError(ValueError):
    """A preset that cannot be read: where it came from, and each thing wrong as ``PLACE: expected what, got what``.

    At most `LISTED` problems are listed; then a last line counts the others. As text, one line for each, with the source
    before it.
    """

    def __init__(self, source: str, problems: Sequence[str]) -> None:
        self.source = source if source.isprintable() else repr(source)
        self.problems = list(problems[:LISTED])
        self.count = len(problems)
        if self.count > LISTED:
            self.problems.append(f"and {self.count - LISTED} more problems")
        super().__init__("\n".join(f"{self.source}: {problem}" for problem in self.problems))

    @property
    def headline(self) -> str:
        """The first problem and how many more there are, on one line."""
        more = f" (and {self.count - 1} more)" if self.count > 1 else ""
        return f"{self.source}: {self.problems[0]}{more}"
