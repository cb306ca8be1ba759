"""Every action as the menus have it, in one list: for the command palette and the sheet of shortcuts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import accumulate
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .actions import Action, Entry
    from .session import Session


@dataclass(frozen=True)
class Command:
    """An action as it stands just now: its id, the menu it is in, and the menu within that one, if any."""

    name: str
    label: str
    menu: str
    within: str
    keys: tuple[str, ...]
    enabled: bool

    @property
    def trail(self) -> str:
        """The way to it through the menus."""
        return f"{self.menu} > {self.within}" if self.within else self.menu


def catalogue(session: Session, actions: Mapping[str, Action], menus: Mapping[str, Iterable[Entry]]) -> tuple[Command, ...]:
    """All of them, in the order of the menus."""
    return tuple(
        Command(name, action.title(session), menu, within, action.shortcuts, action.enabled(session))
        for menu, within, name in _places(menus)
        if (action := actions.get(name))
    )


def _places(menus: Mapping[str, Iterable[Entry]]) -> Iterator[tuple[str, str, str]]:
    """Menu, menu within it, and the action's id."""
    for menu, entries in menus.items():
        for entry in entries:
            if isinstance(entry, tuple):
                yield from ((menu, entry[0], name) for name in entry[1])
            elif entry is not None:
                yield menu, "", entry


def found(query: str, commands: Iterable[Command]) -> list[Command]:
    """Those whose label, with the way through the menus before or after it, has the query's letters in this order, the closest
    first; all where there are no letters yet."""
    if not query.strip():
        return list(commands)
    scored = [(_score(query, command), command) for command in commands]
    return [command for score, command in sorted(scored, key=lambda pair: -pair[0]) if score >= 0]


def _score(query: str, command: Command) -> float:
    """Below 0 without a match; letters of the label count more than those of the way to it, and short labels win."""
    label, trail = command.label, command.trail
    score = max(2 * closeness(query, label), closeness(query, f"{label} {trail}"), closeness(query, f"{trail} {label}"))
    return score - 0.01 * len(label)


def closeness(query: str, text: str) -> float:
    """How well the query's letters, in this order, fit the text: -1 where they don't, more for beginnings of words and for
    letters that follow each other."""
    letters, text = query.casefold().replace(" ", ""), text.casefold()
    best = [0.0] * (len(text) + 1)  # of the letters so far, all of them within so many of the text's first ones
    ending = [-1.0] * (len(text) + 1)  # the same, the last of them being the very last of those
    for letter in letters:
        before, ending = ending, [-1.0] * (len(text) + 1)
        for place, other in enumerate(text):
            if other == letter and best[place] >= 0:
                start = place == 0 or not text[place - 1].isalnum()
                ending[place + 1] = max(best[place] + (2 if start else 1), before[place] + 3 if before[place] >= 0 else -1)
        best = list(accumulate(ending, max))
    return best[-1]
