"""What can be asked or told in a dialog, as values, and the ways to leave the open preset that need asking.

How each dialog is drawn is in `dialogs`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from hqmodel.edit.animation import FPS
from hqmodel.files import Lost

if TYPE_CHECKING:
    from .catalogue import Command

Purpose = Literal["open", "save", "export", "import"]
Unit = Literal["mm", "cm", "m", "in"]
Up = Literal["y", "z"]
Method = Literal["cubes", "radial"]
Choice = Literal["save", "discard"]
Overtaken = Literal["overwrite", "elsewhere"]


@dataclass(frozen=True)
class Open:
    """A preset file instead of the present scene."""

    path: Path


@dataclass(frozen=True)
class New:
    """An empty start instead of the present scene."""


@dataclass(frozen=True)
class Quit:
    """The window closed."""


Departure = Open | New | Quit


@dataclass(frozen=True)
class Unsaved:
    """Work would be lost by leaving. Answered by a Choice."""

    name: str
    departure: Departure


@dataclass(frozen=True)
class Overwrite:
    """The document's file holds what another program wrote there in the meantime. Answered by an Overtaken."""

    path: Path
    departure: Departure | None = None


@dataclass(frozen=True)
class Recover:
    """What windows left that did not end as they should. Answered by one of them and what to do with it."""

    lost: tuple[Lost, ...]


@dataclass(frozen=True)
class Recovered:
    """What to do with it: go on with it, or throw it away."""

    lost: Lost
    wanted: bool


@dataclass(frozen=True)
class ChooseFile:
    """A file to open or to write. Answered by its Path. `replacing`: that there is one already has been said."""

    purpose: Purpose
    folder: Path
    name: str = ""
    endings: tuple[str, ...] = (".json",)
    replacing: bool = False

    @property
    def reading(self) -> bool:
        """Whether the file is to be read, and so must be there."""
        return self.purpose in ("open", "import")

    @property
    def path(self) -> Path:
        """What is chosen so far; a file to be written gets the first ending where it has none of them."""
        path = self.folder / self.name
        if self.reading or path.suffix.lower() in self.endings:
            return path
        return path.with_name(path.name + self.endings[0])


@dataclass(frozen=True)
class Problem:
    """Something went wrong; nothing was lost."""

    title: str
    lines: tuple[str, ...]


@dataclass(frozen=True)
class ExportSettings:
    """What a mesh is written as, and where. None for unit, size or up: what the format's users expect; for the number of
    triangles: all that there are. With a tolerance, in the file's unit, they are as few as that takes at what resolution it
    takes."""

    path: Path
    resolution: int = 256
    method: Method = "cubes"
    target_faces: int | None = None
    tolerance: float | None = None
    unit: Unit | None = None
    size: float | None = None
    up: Up | None = None
    colors: bool = True
    normals: bool = True


@dataclass(frozen=True)
class ExportAs:
    """How the body shall be exported. Answered by ExportSettings. `told` says what that will come to, as far as is known."""

    settings: ExportSettings
    told: Callable[[ExportSettings], str] = field(default=lambda _: "", compare=False)


@dataclass(frozen=True)
class ImportSettings:
    """What is fitted to which points: so many bodies, or as many as it takes, of at most so many strips each."""

    path: Path
    parts: int | None = 1
    strips: int = 8


@dataclass(frozen=True)
class ImportAs:
    """How points or a mesh shall be fitted. Answered by ImportSettings."""

    settings: ImportSettings


@dataclass(frozen=True)
class Exported:
    """What an export has written."""

    path: Path
    seconds: float
    report: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class FilmSettings:
    """What a film shows, and where it is written: one of the scene's animations or none, a turn around the body or not.

    `size` is (width, height) in pixels; `whole`: from so far that all is seen, else from where the camera is.
    """

    path: Path
    animation: int | None
    turning: bool
    seconds: float
    fps: float = FPS
    size: tuple[int, int] = (640, 480)
    whole: bool = False

    @property
    def frames(self) -> int:
        return round(self.seconds * self.fps)


@dataclass(frozen=True)
class FilmAs:
    """How what moves shall be exported. Answered by FilmSettings. `animations`: the name and the seconds of each there is."""

    settings: FilmSettings
    animations: Mapping[int, tuple[str, float]]


@dataclass(frozen=True)
class Filmed:
    """The files that a film was written to, and what to say of it."""

    files: tuple[Path, ...]
    told: str


@dataclass(frozen=True)
class Palette:
    """Every action, to be found by a few letters. Answered by the name of the one to do."""

    commands: tuple[Command, ...]
    query: str = ""
    chosen: int = 0


@dataclass(frozen=True)
class Shortcuts:
    """The list of all shortcuts, and of what the mouse does."""

    commands: tuple[Command, ...]


@dataclass(frozen=True)
class Tour:
    """A few words about each part of the window, for who has never seen it."""

    step: int = 0


@dataclass(frozen=True)
class About:
    """What this program is."""


Saying = Problem | Exported | Filmed | About
Dialog = Unsaved | Overwrite | Recover | ChooseFile | ExportAs | FilmAs | ImportAs | Palette | Shortcuts | Tour | Saying
