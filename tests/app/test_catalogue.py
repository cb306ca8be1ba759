"""The command palette's list: complete, and what a few letters find in it."""

from __future__ import annotations

import pytest

from hqmodel import files
from hqmodel.app.actions import ACTIONS, MENUS
from hqmodel.app.asks import Palette
from hqmodel.app.catalogue import Command, catalogue, closeness, found
from hqmodel.app.intents import Answer, Do
from hqmodel.app.session import Session


@pytest.fixture
def session() -> Session:
    return Session(files.Settings())


@pytest.fixture
def commands(session: Session) -> tuple[Command, ...]:
    return catalogue(session, ACTIONS, MENUS)


def test_every_action_is_there_once(commands: tuple[Command, ...]) -> None:
    assert sorted(command.name for command in commands) == sorted(ACTIONS)
    assert {command.menu for command in commands} == set(MENUS)
    assert sum(len(command.keys) for command in commands) == sum(len(action.shortcuts) for action in ACTIONS.values())


def test_without_letters_all_are_there_in_order(commands: tuple[Command, ...]) -> None:
    assert found(" ", commands) == list(commands)


@pytest.mark.parametrize("name", ACTIONS)
def test_its_whole_label_and_the_way_to_it_find_each(commands: tuple[Command, ...], name: str) -> None:
    command = next(command for command in commands if command.name == name)
    best = found(f"{command.label} {command.trail}", commands)[0]
    assert (best.label, best.trail) == (command.label, command.trail)


@pytest.mark.parametrize(
    ("letters", "name"),
    [
        ("sas", "save as"),
        ("undo", "undo"),
        ("expo", "export"),
        ("addblock", "add block"),
        ("adbl", "add block"),
        ("frall", "frame all"),
        ("LIGHT", "theme light"),
        ("rst lay", "reset layout"),
    ],
)
def test_a_few_letters_find_what_is_meant(commands: tuple[Command, ...], letters: str, name: str) -> None:
    assert found(letters, commands)[0].name == name


def test_letters_must_be_there_in_order(commands: tuple[Command, ...]) -> None:
    assert found("zzzz", commands) == []
    assert closeness("ab", "ba") < 0 <= closeness("ab", "a b")


@pytest.mark.parametrize(("better", "worse"), [("save", "s a v e"), ("over save", "oversave"), ("save", "sable vase")])
def test_together_and_at_the_beginning_of_a_word_is_closer(better: str, worse: str) -> None:
    assert closeness("save", better) > closeness("save", worse)


def test_the_answer_is_done(session: Session) -> None:
    session.apply([Do("palette")])
    assert isinstance(session.dialogs[-1], Palette)
    session.apply([Answer("add block")])
    assert session.history.labels == ["Add block"]
    session.apply([Do("palette"), Answer("about")])
    assert len(session.dialogs) == 1
    session.apply([Answer(), Do("palette"), Answer()])
    assert session.history.labels == ["Add block"]
