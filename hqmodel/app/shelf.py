"""What the Presets panel lists: favourites, what was open lately, one's own folder, and what comes with the program."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from platformdirs import user_documents_path

from hqmodel import files

# So many of the recent files are listed, and at most so many of one's own.
RECENT, OWN = 6, 200


@dataclass(frozen=True)
class Card:
    """One preset: its file, what it is called, and what is said about it."""

    path: Path
    title: str
    description: str

    @property
    def name(self) -> str:
        return self.path.stem

    def has(self, words: Iterable[str]) -> bool:
        """Whether all the words, in small letters, are somewhere in what is said about it."""
        said = f"{self.title} {self.name} {self.description} {self.path.parent.name}".casefold()
        return all(word in said for word in words)


def own_folder() -> Path:
    """Where one's own presets are listed from; it need not exist."""
    return user_documents_path() / "hqmodel"


def favourites(settings: files.Settings) -> list[str]:
    """The paths with a star."""
    kept = settings.preferences.get("favourites")
    return [item for item in kept if isinstance(item, str)] if isinstance(kept, list) else []


@dataclass
class Shelf:
    """The sections and what is in them, as the settings and the folder were when they were read last; and a search."""

    builtin: list[Card] = field(default_factory=list)
    search: str = ""
    _settings: files.Settings | None = None
    _sections: dict[str, list[Card]] = field(default_factory=dict)

    def found(self, settings: files.Settings) -> dict[str, list[Card]]:
        """The sections, with those cards that have all the words searched for; none that is empty."""
        if settings is not self._settings:
            self._settings, self._sections = settings, self._read(settings)
        words = self.search.casefold().split()
        kept = {name: [card for card in cards if card.has(words)] for name, cards in self._sections.items()}
        return {name: cards for name, cards in kept.items() if cards}

    def _read(self, settings: files.Settings) -> dict[str, list[Card]]:
        known = {card.path: card for card in self.builtin}

        def cards(paths: Iterable[Path]) -> list[Card]:
            return [known.get(path) or Card(path, path.stem, str(path)) for path in paths if path.is_file()]

        own = sorted(own_folder().glob("*.json"), key=lambda path: path.name.casefold())
        sections = {
            "Favourites": cards(map(Path, favourites(settings))),
            "Recent": cards(map(Path, settings.recent[:RECENT])),
            "My presets": cards(own[:OWN]),
        }
        for card in self.builtin:
            sections.setdefault(card.path.parent.name.capitalize(), []).append(card)
        return sections


def stocked() -> Shelf:
    """A shelf with what comes with the program: starters first."""
    cards = [Card(preset.path, preset.title, preset.description) for preset in files.builtin()]
    return Shelf(sorted(cards, key=lambda card: card.path.parent.name != "starters"))
