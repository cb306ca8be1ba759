"""The modeller's window. Importing this loads none of it; `run` does."""

from __future__ import annotations

from pathlib import Path

from .display import NoDisplay

__all__ = ["NoDisplay", "run"]


def run(path: Path | None = None) -> None:
    """Open the window, with a preset if there is one; returns when it is closed.

    Raises NoDisplay, one sentence, where no window can be opened. A preset that can't be read is told of in the window.
    """
    from hqmodel.files import Settings

    from .asks import Open
    from .display import require
    from .session import Session

    require()
    from .window import Window

    session = Session(Settings.read())
    if path is not None:
        session.apply([Open(path)])
    Window(session).run()
