"""Copies of unsaved work every two minutes, off the frame's path, and the way back to them after a crash."""

from __future__ import annotations

from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from time import localtime, monotonic, strftime
from typing import TYPE_CHECKING

from hqmodel import files
from hqmodel.model import Scene

from .document import Document

if TYPE_CHECKING:
    from .session import Session

# What is not saved is copied after so many seconds. A window at rest looks every ten: nothing older than two minutes is lost.
PERIOD = 110.0


class Recovery:
    """Keeps copies of a session's work while there is any that is not saved. One thread does all the writing, in order."""

    def __init__(self) -> None:
        self._ring = files.Ring()
        self._writer = ThreadPoolExecutor(1, thread_name_prefix="autosave")
        self._writing: Future[Path | None] | None = None
        self._kept: Scene | None = None
        self._since: float | None = None

    def tick(self, session: Session) -> str:
        """Once a frame: begin whatever is due. Why the last copy could not be written, or nothing."""
        if self._writing is not None and self._writing.done():
            writing, self._writing = self._writing, None
            error = writing.exception()
            if error is not None:
                return f"No copy for safety: {getattr(error, 'strerror', None) or error}"
        if not session.history.dirty:
            if self._kept is not None:
                self._writer.submit(self._ring.clear)
            self._kept = self._since = None
        elif session.scene is not self._kept:
            if self._since is None:
                self._since = monotonic()
            if self._writing is None and monotonic() - self._since >= PERIOD:
                self._writing = self._submit(session)
        return ""

    def keep(self, session: Session) -> Path | None:
        """Write a copy now and wait for it; its file, None where that failed."""
        try:
            return self._submit(session).result()
        except (OSError, files.PresetError):
            return None

    def close(self, keep: bool = False) -> None:
        """The window is closed: its copies go, unless they shall be offered when the next one opens."""
        self._writer.submit(self._ring.abandon if keep else self._ring.clear)
        self._writer.shutdown()

    def _submit(self, session: Session) -> Future[Path | None]:
        self._kept, self._since = session.scene, None
        scene, view, origin = session.scene, session.view.stored(session.scene.view), session.document.origin
        return self._writer.submit(lambda: self._ring.keep(scene.changed(view=view), origin))


def recovered(lost: files.Lost) -> tuple[Document | None, list[str]]:
    """The document as its latest copy has it that can be read, None without one; and what is wrong with those that can't."""
    faults: list[str] = []
    for copy in lost.copies:
        try:
            return Document.recovered(files.load(copy), lost.origin), faults
        except files.PresetError as error:
            faults += str(error).splitlines()
    return None, faults


def said(seconds: float) -> str:
    """A moment as people write it, by the clock here."""
    return strftime("%Y-%m-%d %H:%M", localtime(seconds))
