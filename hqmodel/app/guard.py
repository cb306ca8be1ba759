"""A fault in a panel must not take the work with it: it is told of, the panel rests, and everything else goes on."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterable

from imgui_bundle import imgui

from .intents import Intent
from .session import Session

TITLE = "Something went wrong"


class Guard:
    """Runs what is drawn in a frame. What fails is shown in a dialog, once, and rests until its panel is tried again."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._resting: set[str] = set()

    def run(self, name: str, draw: Callable[[], Iterable[Intent]]) -> None:
        """Draw, and have done what comes out of it."""
        if name in self._resting:
            if imgui.button(f"Try again##{name}"):
                self._resting.discard(name)
            return
        before = imgui.internal.ErrorRecoveryState()
        imgui.internal.error_recovery_store_state(before)
        try:
            self._session.apply(draw())
        except Exception as error:  # whatever it is, the scene is still whole, and the user must learn of it
            _recover(before)
            self._resting.add(name)
            self._report(name, error)

    def _report(self, name: str, error: Exception) -> None:
        self._session.history.cancel()
        traceback.print_exception(error)
        kept = self._session.recovery.keep(self._session) if self._session.history.dirty else None
        lines = [f"{name}: {type(error).__name__}: {error}", "Your work is still here, and can be saved as always."]
        if kept is not None:
            lines.append(f"To be sure, a copy was saved as {kept}")
        self._session.tell(TITLE, lines)


def _recover(before: imgui.internal.ErrorRecoveryState) -> None:
    """Close whatever tables, groups and the like the panel had open when it failed."""
    io = imgui.get_io()
    io.config_error_recovery_enable_assert = False
    imgui.internal.error_recovery_try_to_recover_state(before)
    io.config_error_recovery_enable_assert = True
