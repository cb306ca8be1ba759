"""The preset that is open: its history, the file it belongs to, and what the title says."""

from __future__ import annotations

from pathlib import Path

from hqmodel import edit, files
from hqmodel.model import Scene
from hqmodel.resources import folder

ENDING = ".json"
UNTITLED = "Untitled"


class Document:
    """A scene with its history. `path` is where it is saved; None until it has a file of its own."""

    def __init__(self, scene: Scene | None = None, path: Path | None = None) -> None:
        self.history = edit.History(edit.new_scene() if scene is None else scene)
        self.path = path

    @classmethod
    def opened(cls, path: Path) -> Document:
        """A preset file. One of the built-in ones becomes a new preset, that saving will ask a file for.

        Raises files.PresetError, with all that is wrong with it.
        """
        scene, path = files.load(path), path.resolve()
        return cls(scene, None if folder("presets").resolve() in path.parents else path)

    @property
    def scene(self) -> Scene:
        return self.history.present

    @property
    def name(self) -> str:
        """What people would call it: the file's name, or else the scene's."""
        return self.path.stem if self.path else self.scene.name or UNTITLED

    @property
    def title(self) -> str:
        """The window's title; the star is for work that is not saved."""
        return f"{self.name}{'*' if self.history.dirty else ''} - hqmodel"

    @property
    def file_name(self) -> str:
        """What its file would be called, kept to what every system permits in a name."""
        plain = "".join(c if c.isalnum() or c in " -_." else "-" for c in self.name).strip(" .")
        return f"{plain or UNTITLED}{ENDING}"

    def save(self, path: Path, view: dict[str, object]) -> None:
        """Written to this file, with the view it is seen in; from now on it is this document's own. Raises OSError."""
        self.history.commit()
        files.save(self.scene.changed(view=view), path)
        self.path = path.resolve()
        self.history.mark_saved()
