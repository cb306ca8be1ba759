"""A fault in a panel must not take the work with it: it is told of, the panel rests, and everything else goes on."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterable
from pathlib import Path
from time import strftime

from imgui_bundle import imgui
from platformdirs import user_state_path

from hqmodel import files
from hqmodel.model import Scene

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
        kept = rescued(self._session.scene) if self._session.history.dirty else None
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


def rescued(scene: Scene) -> Path | None:
    """Where a copy of the scene was put, in the program's own folder; None where even that failed."""
    folder = user_state_path("hqmodel", appauthor=False) / "rescued"
    path = folder / f"{strftime('%Y-%m-%d %H-%M-%S')}.json"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        files.save(scene, path)
    except (OSError, files.PresetError) as error:
        traceback.print_exception(error)
        return None
    return path
