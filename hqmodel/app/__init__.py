"""The modeller's window. Importing this loads none of it; `run` does."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from hqmodel.model import Scene

from .display import NoDisplay

__all__ = ["NoDisplay", "run"]


def run(path: Path | None = None, change: Callable[[Scene], Scene] | None = None) -> None:
    """Open the window, with a preset if there is one and then a first edit to it; returns when it is closed.

    Raises NoDisplay, one sentence, where no window can be opened, or the driver loses it. A preset that can't be read is told
    of in the window.
    """
    from hqmodel.files import Settings, lost

    from . import filing
    from .asks import Open
    from .display import require
    from .intents import Do, Edit
    from .session import Session

    scale = require()
    from .window import Window

    session = Session(Settings.read())
    if path is not None:
        session.apply([Open(path)])
    if change is not None:
        session.apply([Edit("Command line", change)])
    if path is None and not session.settings.preferences.get("toured"):
        session.apply([Do("tour")])
    filing.offer(session, lost())
    Window(session, scale=scale).run()
