"""Progress of long work that may be ended at any step."""

from __future__ import annotations

from collections.abc import Callable

Tell = Callable[[float, str], None]


class Told:
    """Tells the share done, which never falls, and what is being done; whatever the one told raises ends the work."""

    def __init__(self, tell: Tell) -> None:
        self._tell = tell
        self._last = 0.0, ""

    def __call__(self, share: float, doing: str) -> None:
        self._last = max(share, self._last[0]), doing
        self.again()

    def again(self) -> None:
        """The same as last: a step of the work is done."""
        self._tell(*self._last)

    def within(self, low: float, high: float) -> Told:
        """What tells of a stage of the work, the share of it done being between these shares of the whole."""
        return Told(lambda share, doing: self(low + (high - low) * share, doing))
