"""How the window shall look and behave, as the settings keep it from one time to the next."""

from __future__ import annotations

from dataclasses import dataclass

from hqmodel.files import Settings

THEMES = ("dark", "light")
# Of everything in the window, in hundredths of its usual size.
SIZES = (80, 90, 100, 110, 125, 150, 175, 200)

# The grid's, in world units.
STEPS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.25, 0.5, 1.0)


@dataclass(frozen=True)
class Preferences:
    """What the settings say, and what is usual where they don't, or say something that can't be used."""

    settings: Settings

    @property
    def theme(self) -> str:
        chosen = self.settings.preferences.get("theme")
        return chosen if chosen in THEMES else THEMES[0]

    @property
    def percent(self) -> int:
        """How large everything in the window is, in hundredths of its usual size."""
        chosen = self.settings.preferences.get("percent")
        return chosen if chosen in SIZES else 100

    @property
    def refining(self) -> bool:
        """Whether the picture gets better while nothing happens; a slow machine may do without."""
        return self.settings.preferences.get("refining") is not False

    @property
    def grid(self) -> bool:
        """Whether the grid is shown; it is there without, too, and is snapped to."""
        return self.settings.preferences.get("grid") is True

    @property
    def grid_step(self) -> float | None:
        """The grid's step; None for one that fits how large things are seen."""
        chosen = self.settings.preferences.get("grid_step")
        return chosen if chosen in STEPS else None

    @property
    def frame_time(self) -> bool:
        """Whether the status bar tells how long frames take."""
        return self.settings.preferences.get("frame_time") is True
