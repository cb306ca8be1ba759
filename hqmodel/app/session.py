"""All that is going on in the window, without the window: what is open, selected, asked, under way, and how intents change it.

Panels read it and return intents; `Session.apply` is the one place where they are carried out, edits through the history.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import reduce
from pathlib import Path
from time import monotonic

from hqmodel import edit, files
from hqmodel.edit.sweeping import animate
from hqmodel.field import Region, region
from hqmodel.model import Camera, Scene, usual

from . import actions, answers
from .asks import (
    ChooseFile,
    Departure,
    Dialog,
    Exported,
    ExportSettings,
    ImportAs,
    ImportSettings,
    New,
    Open,
    Overwrite,
    Problem,
    Quit,
    Recover,
    Unsaved,
)
from .document import ENDING, Document
from .export import ExportJob
from .importing import Cloud, FitJob, Fitted
from .intents import (
    Adjust,
    Animate,
    Answer,
    Ask,
    Choose,
    Do,
    Drop,
    Edit,
    Equip,
    Grab,
    Intent,
    Location,
    Look,
    Pick,
    Play,
    Prefer,
    Pull,
    Put,
    Release,
    Reset,
    Resize,
    See,
    Select,
    Show,
    Stop,
    Take,
)
from .player import Player
from .recovery import Recovery, recovered, said
from .selection import Selection
from .tools.gesture import Held
from .tools.kit import Kit
from .view import View, restored


class Session:
    """One document and what surrounds it. `dialogs` is a stack, the last one in front; `finished` closes the window.

    `wake` asks for a frame and may be called from any thread; `size` is the viewport's, in pixels, as the window last drew it.
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
        self.job: ExportJob | FitJob | None = None
        self.exported: Exported | None = None
        self.cloud: Cloud | None = None
        self.cloud_hidden: bool = False
        self.hidden_panels = set(actions.HIDDEN)
        self.animation: int | None = None
        self.layout_wanted = False
        self.finished = False
        self.kit = Kit()
        self.held: Held | None = None
        self.wanted_gesture = ""
        self.message = ""
        self.failed = False
        self._after_saving: Departure | None = None
        self._held: Location = ()
        self._clicked: tuple[Location, Scene] | None = None
        self._show(Document())

    @property
    def scene(self) -> Scene:
        return self.document.scene

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
    def history(self) -> edit.History:
        return self.document.history

    @property
    def theme(self) -> str:
        chosen = self.settings.preferences.get("theme")
        return chosen if chosen in actions.THEMES else actions.THEMES[0]

    @property
    def percent(self) -> int:
        """How large everything in the window is, in hundredths of its usual size."""
        chosen = self.settings.preferences.get("percent")
        return chosen if chosen in actions.SIZES else 100

    @property
    def refining(self) -> bool:
        """Whether the picture gets better while nothing happens; a slow machine may do without."""
        return self.settings.preferences.get("refining") is not False

    @property
    def frame_time(self) -> bool:
        """Whether the status bar tells how long frames take."""
        return self.settings.preferences.get("frame_time") is True

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

    def apply(self, intents: Iterable[Intent]) -> None:
        """Carry out what panels want done, one after the other."""
        for intent in intents:
            self._apply(intent)
        self.selection = self.selection.within(self.scene)

    def _apply(self, intent: Intent) -> None:
        match intent:
            case Grab(path, label):
                self.release()
                self.history.begin(label)
                self._held = path
            case Put():
                self._change(intent.label, lambda scene: edit.put(scene, intent.path, intent.value))
            case Release():
                self.release()
            case Take(gesture):
                self.release()
                self.player.stop()
                self.history.begin(gesture.label)
                self.held = Held(gesture)
            case Pull(held):
                self.held = held
                self._change(held.gesture.label, lambda _: held.scene)
            case Show(scene):
                self._change("", lambda _: scene)
            case Drop():
                self.drop()
            case Equip(kit):
                self.kit = kit
            case Choose(shapes, add):
                self.selection = self.selection.chosen(shapes, add)
            case Reset():
                self._reset(intent)
            case Edit(label, change):
                self.release()
                self._change(label, change)
            case Select(shape, strip, add):
                self.selection = self.selection.picked(shape, strip, add)
            case Look(camera):
                self.look(camera)
            case See(view):
                self.view = view
            case Resize(size):
                self._resize(size)
            case Play(animation, share, running):
                self.player.play(animation, share, running)
            case Stop():
                self.player.stop()
            case Animate(path, label):
                self._animate(path, label)
            case Pick(animation):
                self.animation = animation
            case Prefer(name, value):
                self.keep(self.settings.preferring(**{name: value}))
            case Do(action):
                actions.perform(self, action)
            case Ask(dialog):
                self.dialogs.append(dialog)
            case Adjust(dialog):
                self.dialogs[-1] = dialog
            case Answer(value):
                answers.take(self, self.dialogs.pop(), value)
            case Open() | New() | Quit():
                self.leave(intent)

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

    # Edits

    def release(self) -> None:
        """What was held is let go: its drag becomes one step."""
        self.held = None
        if self.history.dragging:
            label, steps = self.history.undo_label, len(self.history.labels)
            self.history.commit()
            changed = len(self.history.labels) > steps
            self._clicked = (self._held, self.scene) if changed else None
            if changed:
                self.say(label)

    def drop(self) -> None:
        """What was held is let go, and everything put back."""
        self.history.cancel()
        self.held = None
        self.say("")

    def undo(self) -> None:
        self.held = None
        if self.history.can_undo:
            label = self.history.undo_label
            self.history.undo()
            self.say(f"Undone: {label}")

    def redo(self) -> None:
        if self.history.can_redo:
            label = self.history.redo_label
            self.history.redo()
            self.say(f"Done again: {label}")

    def _change(self, label: str, change: Callable[[Scene], Scene]) -> None:
        try:
            scene = change(self.scene)
        except edit.EditError as error:
            self.complain(str(error))
            return
        if self.history.dragging:
            self.history.preview(scene)
            self.say("")
        else:
            self.history.apply(scene, label)
            self.say(label)

    def _animate(self, path: Location, label: str) -> None:
        """In the animation that is picked, or in a new one, which is picked then; and the timeline is there to see."""
        self.release()
        count = len(self.scene.animations)
        index = self.animation if self.animation is not None and self.animation < count else None
        self._change(f"Animate {label}", lambda scene: animate(scene, path, index, label))
        if index is None and len(self.scene.animations) > count:
            self.animation = count
        self.hidden_panels.discard("Timeline")

    def _reset(self, intent: Reset) -> None:
        """The first click of a double click has moved the slider: that step goes."""
        self.history.cancel()
        if self._clicked is not None and self._clicked[0] == intent.path and self._clicked[1] is self.scene:
            self.history.undo()
        self._change(intent.label, lambda scene: edit.reset(scene, intent.path))

    # Files

    def leave(self, departure: Departure) -> None:
        """Go to another preset, or out; ask first where work would be lost."""
        self.release()
        if self.history.dirty:
            self.dialogs.append(Unsaved(self.document.name, departure))
        else:
            self.depart(departure)

    def depart(self, departure: Departure) -> None:
        """Go without asking. A preset that cannot be read is told of, and everything stays as it was."""
        match departure:
            case New():
                self._show(Document())
                self.say("New")
            case Open(path):
                self._open(path)
            case Quit():
                if self.job is not None:
                    self.job.cancel()
                    self.job.wait()
                self.finished = True

    def save(self, path: Path | None, then: Departure | None = None) -> None:
        """Save to this file, or ask for one where there is none yet, and then go on to somewhere else.

        What another program wrote to the document's own file is not overwritten without a question.
        """
        self._after_saving = then
        if path is None:
            self.dialogs.append(ChooseFile("save", self.folder, self.document.file_name))
        elif path == self.document.path and self.document.overtaken:
            self.dialogs.append(Overwrite(path, then))
        else:
            self.write(path, then)

    def write(self, path: Path, then: Departure | None = None) -> None:
        """Save to this file, whatever it holds."""
        try:
            kept = self.document.save(path, self.view.stored(self.scene.view))
        except (OSError, files.PresetError) as error:
            self.tell("Not saved", _lines(path, error))
            return
        self.keep(self.settings.opened(path))
        self.say(f"Saved {path.name}" if kept else f"Saved {path.name}; the version before it could not be kept")
        if then is not None:
            self.depart(then)

    def save_chosen(self, path: Path | None) -> None:
        """The answer to where to save; without one, whatever was to come after saving is off too."""
        if path is not None:
            self.save(path, self._after_saving)
        self._after_saving = None

    @property
    def folder(self) -> Path:
        """Where file dialogs begin."""
        recent = [self.document.path, *map(Path, self.settings.recent)]
        return next((path.parent for path in recent if path is not None and path.parent.is_dir()), Path.home())

    def keep(self, settings: files.Settings) -> None:
        """Remember these from now on, beyond the window's end where the system lets us."""
        self.settings = settings
        settings.write()

    def offer(self, lost: Iterable[files.Lost]) -> None:
        """Ask what to do with the work that windows left which did not end as they should."""
        found = tuple(lost)
        if found:
            self.dialogs.append(Recover(found))

    def recover(self, lost: files.Lost, others: Iterable[files.Lost]) -> None:
        """Go on where that window was; the other ones' work is offered again next time."""
        document, faults = recovered(lost)
        if document is None:
            self.offer([lost, *others])
            self.tell("Not recovered", faults)
            return
        for other in others:
            other.release()
        self._show(document)
        self.say(f"Recovered {lost.origin.name}, as it was at {said(lost.time)}")
        lost.discard() if self.recovery.keep(self) else lost.release()
        if faults:
            self.tell("Recovered from the copy before the last one", faults)

    def forget(self, lost: files.Lost, others: Iterable[files.Lost]) -> None:
        """Throw that work away."""
        lost.discard()
        self.offer(others)

    def _open(self, path: Path) -> None:
        try:
            document = Document.opened(path)
        except (OSError, files.PresetError) as error:
            self.tell("Not opened", _lines(path, error))
            self.keep(self.settings.forgetting(path))
            return
        self._show(document)
        if document.path is not None:
            self.keep(self.settings.opened(document.path))
        self.say(f"Opened {document.name}")

    def _show(self, document: Document) -> None:
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

    # Views and exports

    def look(self, camera: Camera) -> None:
        """See it from elsewhere."""
        self.view = self.view.moved(camera)
        self._untouched = False

    def frame(self, box: Region) -> None:
        """Look at all of this box."""
        aspect = self.size[0] / max(self.size[1], 1)
        self.look(self.view.camera.framing(box.low, box.high, aspect))

    def _resize(self, size: tuple[int, int]) -> None:
        """As long as nobody has moved the camera, all of the body stays in view."""
        self.size = size
        if self._untouched:
            self.frame(self.region)
            self._untouched = True

    def start_export(self, settings: ExportSettings) -> None:
        """Begin an export in the background."""
        self.release()
        self.job = ExportJob(self.scene, settings, self.wake)
        self.say(f"Exporting {settings.path.name}")

    def take_file(self, path: Path) -> None:
        """A file was dropped on the window: a preset opens, points and meshes are fitted."""
        if path.suffix.lower() == ENDING:
            self.apply([Open(path)])
            return
        from hqmodel.fit import FORMATS  # late: it takes a second, and few need it

        self.apply([Ask(ImportAs(ImportSettings(path))) if path.suffix.lower() in FORMATS else Open(path)])

    def start_fit(self, settings: ImportSettings) -> None:
        """Begin to fit hyperquadrics to a file's points, in the background."""
        self.release()
        self.job = FitJob(settings, self.wake)
        self.say(f"Fitting {settings.path.name}")

    def poll(self) -> None:
        """Once a frame: tell how a job ended, keep copies of what is not saved, and go on with what plays."""
        self.player.advance(monotonic())
        fault = self.recovery.tick(self)
        if fault:
            self.complain(fault)
        job = self.job
        if job is None or job.running:
            return
        self.job = None
        match job.outcome:
            case None:
                self.say(f"{job.noun} cancelled; {job.aftermath}")
            case Problem():
                self.dialogs.append(job.outcome)
                self.say(f"{job.noun} failed")
            case Exported():
                self.exported = job.outcome
                self.dialogs.append(job.outcome)
                self.say(f"Exported {job.settings.path.name}")
            case Fitted():
                self._take_in(job.outcome)

    def _take_in(self, fitted: Fitted) -> None:
        """What was fitted comes in place of a scene nobody has touched, else beside what there is."""
        fresh = self.document.path is None and not self.history.labels
        count = 0 if fresh else len(self.scene.shapes)

        def change(scene: Scene) -> Scene:
            return fitted.scene if fresh else reduce(edit.add_shape, fitted.scene.shapes, scene)

        self.apply([Edit("Fit", change), Choose(tuple(range(count, count + len(fitted.scene.shapes))))])
        self.cloud = fitted.cloud
        if fresh:
            self.frame(self.region)
        self.say(fitted.told)


def _lines(path: Path, error: OSError | files.PresetError) -> list[str]:
    if isinstance(error, files.PresetError):
        return str(error).splitlines()
    return [f"{path}: {error.strerror or error}"]
