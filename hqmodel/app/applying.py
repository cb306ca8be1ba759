"""Intents carried out: the one place where what panels want becomes what there is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hqmodel import edit

from . import actions, answers, editing, filing
from .asks import New, Open, Quit
from .intents import (
    Adjust,
    Animate,
    Answer,
    Ask,
    Choose,
    Do,
    Drop,
    Edit,
    Editing,
    Equip,
    Grab,
    Intent,
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
    Seeing,
    Select,
    Show,
    Stop,
    Take,
)

if TYPE_CHECKING:
    from .session import Session


def carry_out(session: Session, intent: Intent) -> None:
    """Do what is wanted."""
    if isinstance(intent, Editing):
        _edit(session, intent)
        return
    if isinstance(intent, Seeing):
        _see(session, intent)
        return
    match intent:
        case Select(shape, strip, add, image):
            session.selection = session.selection.picked(shape, strip, add, image)
        case Choose(shapes, add):
            session.selection = session.selection.chosen(shapes, add)
        case Pick(animation):
            session.animation = animation
        case Equip(kit):
            session.kit = kit
        case Prefer(name, value):
            session.keep(session.settings.preferring(**{name: value}))
        case Do(action):
            actions.perform(session, action)
        case Ask(dialog):
            session.dialogs.append(dialog)
        case Adjust(dialog):
            session.dialogs[-1] = dialog
        case Answer(value):
            answers.take(session, session.dialogs.pop(), value)
        case Open() | New() | Quit():
            filing.leave(session, intent)


def _edit(session: Session, intent: Editing) -> None:
    match intent:
        case Grab(path, label):
            editing.grab(session, path, label)
        case Put(path, value, label):
            editing.change(session, label, lambda scene: edit.put(scene, path, value))
        case Release():
            editing.release(session)
        case Reset(path, label):
            editing.reset(session, path, label)
        case Edit(label, change):
            editing.release(session)
            editing.change(session, label, change)
        case Take(gesture):
            editing.take(session, gesture)
        case Pull(held):
            session.held = held
            editing.change(session, held.gesture.label, lambda _: held.scene)
        case Show(scene):
            editing.change(session, "", lambda _: scene)
        case Drop():
            editing.drop(session)
        case Animate(path, label):
            editing.set_in_motion(session, path, label)


def _see(session: Session, intent: Seeing) -> None:
    match intent:
        case Look(camera):
            session.look(camera)
        case See(view):
            session.view = view
        case Resize(size):
            session.resize(size)
        case Play(animation, share, running):
            session.player.play(animation, share, running)
        case Stop():
            session.player.stop()
