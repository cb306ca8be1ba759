"""Edits through the history: what is held, let go, put back, undone and done again; and what each says in the status bar."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from hqmodel import edit
from hqmodel.edit.sweeping import animate
from hqmodel.model import Scene

from .intents import Location
from .tools.gesture import Gesture, Held

if TYPE_CHECKING:
    from .session import Session


def grab(session: Session, path: Location, label: str) -> None:
    """A control is held from now on: what it changes is one step."""
    release(session)
    session.history.begin(label)
    session.grabbed = path


def take(session: Session, gesture: Gesture) -> None:
    """The hand holds something from now on: what comes of it is one step."""
    release(session)
    session.player.stop()
    session.history.begin(gesture.label)
    session.held = Held(gesture)


def release(session: Session) -> None:
    """What was held is let go: its drag becomes one step."""
    session.held = None
    if session.history.dragging:
        label, steps = session.history.undo_label, len(session.history.labels)
        session.history.commit()
        changed = len(session.history.labels) > steps
        session.clicked = (session.grabbed, session.scene) if changed else None
        if changed:
            session.say(label)


def drop(session: Session) -> None:
    """What was held is let go, and everything put back."""
    session.history.cancel()
    session.held = None
    session.say("")


def undo(session: Session) -> None:
    """One step back, if there is one."""
    session.held = None
    if session.history.can_undo:
        label = session.history.undo_label
        session.history.undo()
        session.say(f"Undone: {label}")


def redo(session: Session) -> None:
    """One step forward again, if there is one."""
    if session.history.can_redo:
        label = session.history.redo_label
        session.history.redo()
        session.say(f"Done again: {label}")


def change(session: Session, label: str, changed: Callable[[Scene], Scene]) -> None:
    """The scene as the drag under way has it, or a step of its own; why not, where it can't be."""
    try:
        scene = changed(session.scene)
    except edit.EditError as error:
        session.complain(str(error))
        return
    if session.history.dragging:
        session.history.preview(scene)
        session.say("")
    else:
        session.history.apply(scene, label)
        session.say(label)


def set_in_motion(session: Session, path: Location, label: str) -> None:
    """In the animation that is picked, or in a new one, which is picked then; and the timeline is there to see."""
    release(session)
    count = len(session.scene.animations)
    index = session.animation if session.animation is not None and session.animation < count else None
    change(session, f"Animate {label}", lambda scene: animate(scene, path, index, label))
    if index is None and len(session.scene.animations) > count:
        session.animation = count
    session.hidden_panels.discard("Timeline")


def reset(session: Session, path: Location, label: str) -> None:
    """The first click of a double click has moved the slider: that step goes."""
    session.history.cancel()
    if session.clicked is not None and session.clicked[0] == path and session.clicked[1] is session.scene:
        session.history.undo()
    change(session, label, lambda scene: edit.reset(scene, path))
