"""All that is going on in the window, without the window: what is open, selected, asked, under way.

Panels read it and return intents; `Session.apply` is the one place where they are carried out, edits through the history.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from time import monotonic

from hqmodel import edit, files
from hqmodel.field import Region, region
from hqmodel.model import Camera, Scene, usual

from . import actions, applying, working
from .asks import Departure, Dialog, Exported, Problem
from .document import Document
from .export import ExportJob
from .filming import FilmJob
from .importing import Cloud, FitJob
from .intents import Intent, Location
from .player import Player
from .preferences import Preferences
from .recovery import Recovery
from .selection import Selection
from .tools.gesture import Held
from .tools.kit import Kit
from .view import View, restored


class Session:
    """One document and what surrounds it. `dialogs` is a stack, the last one in front; `finished` closes the window.

    `wake` asks for a frame and may be called from any thread; `size` is the viewport's, in pixels, as the window last drew it.
    `grabbed` is the control that is or was held last, `clicked` what it has changed and the scene that came of it.
    """

    document: Document
    selection: Selection
    view: View
    _region: tuple[Scene, Region]
    _untouched: bool

    def __init__(self, settings: files.Settings, wake: Callable[[], None] = lambda: None) -> None:
        self.settings = settings
        self.recovery = Recovery()
        self.player = Player()
        self.wake = wake
        self.size = (800, 600)
        self.dialogs: list[Dialog] = []
        self.job: ExportJob | FilmJob | FitJob | None = None
        self.exported: Exported | None = None
        self.cloud: Cloud | None = None
        self.cloud_hidden: bool = False
        self.hidden_panels = set(actions.HIDDEN)
        self.animation: int | None = None
        self.layout_wanted = False
        self.finished = False
        self.kit = Kit()
        self.held: Held | None = None
        self.grabbed: Location = ()
        self.clicked: tuple[Location, Scene] | None = None
        self.wanted_gesture = ""
        self.message = ""
        self.failed = False
        self.after_saving: Departure | None = None
        self.show(Document())

    @property
    def scene(self) -> Scene:
        return self.document.scene

    @property
    def history(self) -> edit.History:
        return self.document.history

    @property
    def preferences(self) -> Preferences:
        return Preferences(self.settings)

    def apply(self, intents: Iterable[Intent]) -> None:
        """Carry out what panels want done, one after the other."""
        for intent in intents:
            applying.carry_out(self, intent)
        self.selection = self.selection.within(self.scene)

    def keep(self, settings: files.Settings) -> None:
        """Remember these from now on, beyond the window's end where the system lets us."""
        self.settings = settings
        settings.write()

    def poll(self) -> None:
        """Once a frame: go on with what plays, keep copies of what is not saved, and tell how work ended."""
        self.player.advance(monotonic())
        fault = self.recovery.tick(self)
        if fault:
            self.complain(fault)
        working.look_after(self)

    # What is said

    def say(self, message: str) -> None:
        """A line for the status bar."""
        self.message, self.failed = message, False

    def complain(self, message: str) -> None:
        """A line for the status bar about what could not be done."""
        self.message, self.failed = message, True

    def tell(self, title: str, lines: Iterable[str]) -> None:
        """A dialog about what went wrong."""
        self.dialogs.append(Problem(title, tuple(lines)))

    # What is seen

    def show(self, document: Document) -> None:
        """From now on this is the document, seen as it was saved or else from where all of it is seen."""
        self.document = document
        self.player.stop()
        self.animation = self.cloud = self.exported = None
        self._region = document.scene, region(document.scene)
        self.selection = Selection((0,)).within(document.scene)
        view = restored(document.scene.view)
        self.view = view or View(usual(document.scene.dimension))
        if view is None:
            self.frame(self.region)
        self._untouched = view is None

    @property
    def shown(self) -> Scene:
        """The scene as it is to be seen: as an animation has it, while one plays."""
        try:
            return self.player.scene(self.scene)
        except edit.EditError as error:
            self.player.stop()
            self.complain(str(error))
            return self.scene

    @property
    def shown_view(self) -> View:
        """The view, led by an animation while one plays that leads it."""
        return self.view.moved(self.player.camera(self.view.camera))

    @property
    def region(self) -> Region:
        """Where the body is, for the scene as it stands."""
        if self._region[0] is not self.scene:
            self._region = self.scene, region(self.scene)
        return self._region[1]

    @property
    def shown_region(self) -> Region:
        """Where the body is that was shown last: what is known of it without working it out."""
        return self._region[1]

    def located(self, scene: Scene, where: Region) -> None:
        """Somebody has worked out where this scene's body is."""
        self._region = scene, where

    def look(self, camera: Camera) -> None:
        """See it from elsewhere."""
        self.view = self.view.moved(camera)
        self._untouched = False

    def frame(self, box: Region) -> None:
        """Look at all of this box."""
        aspect = self.size[0] / max(self.size[1], 1)
        self.look(self.view.camera.framing(box.low, box.high, aspect))

    def resize(self, size: tuple[int, int]) -> None:
        """As long as nobody has moved the camera, all of the body stays in view."""
        self.size = size
        if self._untouched:
            self.frame(self.region)
            self._untouched = True
