"""The system's own file dialogs, where there are any."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from typing import Any

from imgui_bundle import portable_file_dialogs

from .asks import ChooseFile
from .intents import Answer, Intent


def available() -> bool:
    """On Linux they are other programs, which need not be there."""
    return not sys.platform.startswith("linux") or any(map(shutil.which, ("zenity", "kdialog")))


class NativeChooser:
    """One dialog at a time: `poll` opens it for what is asked and gives the answer when there is one."""

    def __init__(self) -> None:
        self._asked: ChooseFile | None = None
        self._open: Any = None

    def poll(self, asked: ChooseFile) -> list[Intent]:
        """Called every frame while this is asked."""
        if asked is not self._asked:
            self._asked, self._open = asked, _opened(asked)
        if not self._open.ready(0):
            return []
        result, self._asked, self._open = self._open.result(), None, None
        chosen = result[0] if isinstance(result, list) and result else result
        return [Answer(_with_ending(Path(chosen), asked) if chosen else None)]


def _opened(asked: ChooseFile) -> Any:
    filters = ["Presets" if ".json" in asked.endings else "Files", " ".join(f"*{ending}" for ending in asked.endings)]
    if asked.reading:
        return portable_file_dialogs.open_file(
            "Open" if asked.purpose == "open" else "Import", str(asked.folder), [*filters, "All files", "*"]
        )
    title = "Save As" if asked.purpose == "save" else "Export To"
    return portable_file_dialogs.save_file(title, str(asked.folder / asked.name), filters)


def _with_ending(path: Path, asked: ChooseFile) -> Path:
    return ChooseFile(asked.purpose, path.parent, path.name, asked.endings).path
