"""The preset that is open: its history, the file it belongs to, and what the title says."""

from __future__ import annotations

from pathlib import Path

from hqmodel import edit, files
from hqmodel.model import Scene
from hqmodel.resources import folder

ENDING = ".json"
UNTITLED = "Untitled"


class Document:
    """A scene with its history. `path` is where it is saved; None until it has a file of its own.

    `fingerprint` tells what that file held when it was read or written last.
    """

    def __init__(self, scene: Scene | None = None, path: Path | None = None, fingerprint: str | None = None) -> None:
        self.history = edit.History(edit.new_scene() if scene is None else scene)
        self.path = path
        self.fingerprint = fingerprint

    @classmethod
    def opened(cls, path: Path) -> Document:
        """A preset file. A built-in one, or an earlier version of a file, becomes a new preset, that saving will ask a file for.

        Raises files.PresetError, with all that is wrong with it.
        """
        fingerprint = files.fingerprint(path)
        scene, path = files.load(path), path.resolve()
        apart = any(place.resolve() in path.parents for place in (folder("presets"), files.state_folder()))
        return cls(scene) if apart else cls(scene, path, fingerprint)

    @classmethod
    def recovered(cls, scene: Scene, origin: files.Origin) -> Document:
        """Work that was never saved, on the document that it was of."""
        document = cls(scene, Path(origin.path) if origin.path else None, origin.fingerprint)
        document.history.mark_unsaved()
        return document

    @property
    def scene(self) -> Scene:
        return self.history.present

    @property
    def name(self) -> str:
        """What people would call it: the file's name, or else the scene's."""
        return self.path.stem if self.path else self.scene.name or UNTITLED

    @property
    def origin(self) -> files.Origin:
        """What a copy of it is a copy of."""
        return files.Origin(self.name, str(self.path) if self.path else None, self.fingerprint)

    @property
    def overtaken(self) -> bool:
        """Whether another program, or another window, has written to its file since this one read it."""
        present = files.fingerprint(self.path) if self.path else None
        return present is not None and present != self.fingerprint

    @property
    def title(self) -> str:
        """The window's title; the star is for work that is not saved."""
        return f"{self.name}{'*' if self.history.dirty else ''} - hqmodel"

    @property
    def file_name(self) -> str:
        """What its file would be called, kept to what every system permits in a name."""
        plain = "".join(c if c.isalnum() or c in " -_." else "-" for c in self.name).strip(" .")
        return f"{plain or UNTITLED}{ENDING}"

    def save(self, path: Path, view: dict[str, object]) -> bool:
        """Written to this file, with the view it is seen in; from now on it is this document's own.

        Whether what the file held before was kept. Raises OSError.
        """
        self.history.commit()
        kept = files.back_up(path)
        files.save(self.scene.changed(view=view), path)
        self.path, self.fingerprint = path.resolve(), files.fingerprint(path)
        self.history.mark_saved()
        return kept
