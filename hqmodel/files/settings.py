"""What the program remembers between runs: recent files and preferences, where each system keeps such things."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from platformdirs import user_config_path, user_state_path

from .atomic import atomic

RECENT = 12


def settings_folder() -> Path:
    """The folder for the program's settings; it need not exist."""
    return user_config_path("hqmodel", appauthor=False)


def state_folder() -> Path:
    """The folder for what the program keeps for safety: copies of unsaved work, earlier versions; it need not exist."""
    return user_state_path("hqmodel", appauthor=False)


@dataclass(frozen=True)
class Settings:
    """The recent files' absolute paths, the latest first, and whatever the modeller prefers, as plain JSON data."""

    recent: tuple[str, ...] = ()
    preferences: dict[str, Any] = field(default_factory=dict)

    @classmethod
    def read(cls) -> Settings:
        """What was kept; the defaults where there is nothing, or nothing that can be read."""
        try:
            tree = json.loads((settings_folder() / "settings.json").read_bytes())
            recent = tuple(item for item in tree["recent"] if isinstance(item, str))
            return cls(recent[:RECENT], dict(tree["preferences"]))
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            return cls()

    def write(self) -> bool:
        """Keep these; False where the system does not let us (a read-only home is no error)."""
        text = json.dumps({"recent": self.recent, "preferences": self.preferences}, indent=1)
        try:
            settings_folder().mkdir(parents=True, exist_ok=True)
            with atomic(settings_folder() / "settings.json") as stream:
                stream.write(text.encode())
        except OSError:
            return False
        return True

    def opened(self, path: str | os.PathLike[str]) -> Settings:
        """With this file as the latest one."""
        latest = str(Path(path).absolute())
        return replace(self, recent=(latest, *(item for item in self.recent if item != latest))[:RECENT])

    def forgetting(self, path: str | os.PathLike[str]) -> Settings:
        """Without this file among the recent ones."""
        gone = str(Path(path).absolute())
        return replace(self, recent=tuple(item for item in self.recent if item != gone))

    def preferring(self, **preferences: Any) -> Settings:
        """With some preferences changed."""
        return replace(self, preferences={**self.preferences, **preferences})
