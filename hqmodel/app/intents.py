"""What a panel can want done: small values that panels return and `Session.apply` carries out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from hqmodel.edit.animation import Animation
from hqmodel.model import Camera, Scene, Vector

from .asks import Departure, Dialog
from .selection import ITSELF
from .tools.gesture import Gesture, Held
from .tools.kit import Kit
from .view import View

Location = tuple[str | int, ...]


@dataclass(frozen=True)
class Grab:
    """A control was pressed: all that is put until it is let go is one undo step."""

    path: Location
    label: str


@dataclass(frozen=True)
class Put:
    """A field's new value, shown at once. Part of the grabbed control's step, or a step of its own."""

    path: Location
    value: object
    label: str


@dataclass(frozen=True)
class Release:
    """Whatever was grabbed has been let go."""


@dataclass(frozen=True)
class Take:
    """The hand takes hold of something in the viewport: all until it lets go is one undo step."""

    gesture: Gesture


@dataclass(frozen=True)
class Pull:
    """What is held has come so far."""

    held: Held


@dataclass(frozen=True)
class Show:
    """The scene as the drag under way has it now."""

    scene: Scene


@dataclass(frozen=True)
class Drop:
    """Whatever is held is let go of, and everything is as it was before."""


@dataclass(frozen=True)
class Equip:
    """Another tool in hand, or the tool set otherwise."""

    kit: Kit


@dataclass(frozen=True)
class Choose:
    """These shapes selected, and no others unless `add`."""

    shapes: tuple[int, ...]
    add: bool = False


@dataclass(frozen=True)
class Reset:
    """The field back to its default; a click on the same control just before is forgotten."""

    path: Location
    label: str


@dataclass(frozen=True)
class Edit:
    """A named change of the whole scene, one undo step."""

    label: str
    change: Callable[[Scene], Scene]


@dataclass(frozen=True)
class Select:
    """A shape, or one strip of it, in one of its mirror images; `add` keeps what was selected. No shape: nothing selected."""

    shape: int | None
    strip: int | None = None
    add: bool = False
    image: Vector = ITSELF


@dataclass(frozen=True)
class Look:
    """The viewport's camera moved."""

    camera: Camera


@dataclass(frozen=True)
class See:
    """Shown otherwise, or from elsewhere."""

    view: View


@dataclass(frozen=True)
class Resize:
    """The viewport has so many pixels now."""

    size: tuple[int, int]


@dataclass(frozen=True)
class Play:
    """An animation shown, from a moment on (see `Player`), or that moment alone; nothing of the scene changes."""

    animation: Animation
    share: float | None = None
    running: bool = True


@dataclass(frozen=True)
class Animate:
    """This number set in motion, in the animation that is picked or in a new one."""

    path: Location
    label: str


@dataclass(frozen=True)
class Pick:
    """The animation that is worked on."""

    animation: int | None


@dataclass(frozen=True)
class Stop:
    """No animation is shown any more."""


@dataclass(frozen=True)
class Prefer:
    """A preference, remembered from now on."""

    name: str
    value: object


@dataclass(frozen=True)
class Do:
    """An action of the table, by its id."""

    action: str


@dataclass(frozen=True)
class Answer:
    """The foremost dialog's answer: None for cancelled, else what that dialog says."""

    value: object = None


@dataclass(frozen=True)
class Ask:
    """A dialog in front of all others."""

    dialog: Dialog


@dataclass(frozen=True)
class Adjust:
    """The foremost dialog with something in it changed; it stays open."""

    dialog: Dialog


# What changes the scene, or is a part of doing so; what is seen of it; and the rest.
Editing = Grab | Put | Release | Reset | Edit | Take | Pull | Show | Drop | Animate
Seeing = Look | See | Resize | Play | Stop
Intent = Editing | Seeing | Select | Choose | Pick | Equip | Prefer | Do | Ask | Adjust | Answer | Departure
