"""What holds for every command: which one is meant, common options, and how a run ends."""

from __future__ import annotations

import errno
import json
import re
import signal
from pathlib import Path
from typing import Any

import pytest

import hqmodel as package
from hqmodel import app
from hqmodel.__main__ import main_window
from hqmodel.files import load
from hqmodel.model import Scene

from .conftest import BALL, Command, Ended, files


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[tuple[Path | None, Any]]:
    """What the window was asked to open; none opens."""
    calls: list[tuple[Path | None, Any]] = []
    monkeypatch.setattr(app, "run", lambda path, change=None: calls.append((path, change)))
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    return calls


def test_the_version_is_the_packages(hqmodel: Command) -> None:
    assert hqmodel("--version") == Ended(0, f"hqmodel {package.__version__}\n", "")


@pytest.mark.parametrize("command", ["edit", "export", "render", "sample", "raycast", "check", "presets"])
def test_every_command_knows_the_version(hqmodel: Command, command: str) -> None:
    assert hqmodel(command, "--version") == Ended(0, f"hqmodel {package.__version__}\n", "")
    assert hqmodel(command, "ball.json", "--version") == Ended(0, f"hqmodel {package.__version__}\n", "")
    assert hqmodel(command, "--", "--version").out != f"hqmodel {package.__version__}\n"


def test_help_names_every_command_whole(hqmodel: Command) -> None:
    ended = hqmodel("--help")
    assert ended.status == 0
    for command in ("edit", "export", "render", "sample", "raycast", "check", "presets"):
        assert re.search(rf"^  {command} .*\.$", ended.out, re.MULTILINE)
        assert hqmodel(command, "--help").out.startswith(f"Usage: hqmodel {command} ")
    assert "..." not in ended.out.split("Commands:")[1]


@pytest.mark.parametrize("arguments", [[], ["edit"]])
def test_without_a_preset_the_modeller_opens(hqmodel: Command, opened: list[Any], arguments: list[str]) -> None:
    assert hqmodel(*arguments) == Ended(0, "", "")
    assert opened == [(None, None)]


@pytest.mark.parametrize("arguments", [["ball.json"], ["edit", "ball.json"]])
def test_with_a_preset_it_opens_that(hqmodel: Command, opened: list[Any], arguments: list[str]) -> None:
    assert hqmodel(*arguments) == Ended(0, "", "")
    assert opened == [(Path("ball.json"), None)]


def test_desktops_open_files_without_a_terminal_to_tell_faults_on(
    hqmodel: Command, opened: list[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    Path("bad.json").write_text("{")
    monkeypatch.setattr("sys.argv", ["hqmodel-gui", "bad.json"])
    with pytest.raises(SystemExit) as caught:
        main_window()
    assert caught.value.code == 0
    assert opened == [(Path("bad.json"), None)]


def test_changes_come_as_a_first_edit(hqmodel: Command, opened: list[Any]) -> None:
    assert hqmodel("--slice", 0.25, "ball.json", "--set", "gamma=5").status == 0
    ((path, change),) = opened
    changed: Scene = change(load(path))
    assert changed.slice == 0.25
    assert {strip.gamma for strip in changed.shapes[0].strips} == {5.0}


def test_a_preset_at_fault_is_told_before_any_window_opens(hqmodel: Command, opened: list[Any]) -> None:
    Path("bad.json").write_text("{")
    assert hqmodel("bad.json").status == 1
    assert hqmodel("ball.json", "--set", "gamma=0").status == 2
    assert opened == []


def test_without_a_display_the_headless_commands_are_named(hqmodel: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    ended = hqmodel("ball.json")
    assert (ended.status, ended.out) == (3, "")
    assert "display" in one_line(ended.err)
    for command in ("export", "render", "sample", "raycast", "check", "presets"):
        assert command in ended.err


def one_line(text: str) -> str:
    assert text.endswith("\n")
    assert text.count("\n") == 1
    return text[:-1]


@pytest.mark.parametrize(
    ("arguments", "command", "culprit"),
    [
        (["exprot"], "hqmodel", "expected a command or a preset, got 'exprot': did you mean export?"),
        (["export"], "hqmodel export", "PRESET"),
        (["export", "ball.json"], "hqmodel export", "-o"),
        (["export", "ball.json", "-o"], "hqmodel", "-o"),
        (["ball.json", "other.json"], "hqmodel edit", "other.json"),
        (["check", "--colour"], "hqmodel check", "--colour"),
        (["check"], "hqmodel check", "PRESET"),
    ],
)
def test_a_wrong_command_line_is_told_in_one_line(hqmodel: Command, arguments: list[str], command: str, culprit: str) -> None:
    status, out, err = hqmodel(*arguments)
    assert (status, out) == (2, "")
    assert one_line(err).startswith(f"{command}: ")
    assert one_line(err).endswith(f" (see {command} --help)")
    assert culprit in err


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--set", "gamma"], "--set: expected PATH=VALUE, got 'gamma'"),
        (["--set", "=3"], "--set: expected PATH=VALUE, got '=3'"),
        (["--set", "gamma=-3"], "--set: shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got -3"),
        (["--set", "gamma=much"], "--set: shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got 'much'"),
        (["--set", "gamma=NaN"], "--set: shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got nan"),
        (["--set", "shapes[3].hardness=1"], "--set: shapes[3]: expected an index from 0 to 0, got 3"),
        (["--set", "gama=1"], "--set: gama: expected a field of the scene, its shapes or strips, got 'gama'"),
        (["--slice", "nan"], "--slice: slice: expected a finite number, got nan"),
        (["--set", "level=" + "[" * 100_000], "--set: level: expected a finite number, got '" + "[" * 56 + "..."),
    ],
    ids=lambda value: value[1][:20] if isinstance(value, list) else "",
)
def test_wrong_changes_are_the_command_lines_fault(hqmodel: Command, options: list[str], message: str) -> None:
    assert hqmodel("export", "ball.json", "-o", "a.obj", *options) == Ended(2, "", message + "\n")
    assert files() == {"ball.json"}


def test_values_are_json_or_else_text(hqmodel: Command, opened: list[Any]) -> None:
    options = ["name=Two words", "shapes[0].visible=false", "shapes[0].color=[1, 0.5, 0]", "shapes[0].transform.scale[1]=2e-1"]
    assert hqmodel("ball.json", *[part for option in options for part in ("--set", option)]).status == 0
    scene = opened[0][1](load("ball.json"))
    (shape,) = scene.shapes
    assert (scene.name, shape.visible, shape.color, shape.transform.scale[1]) == ("Two words", False, (1.0, 0.5, 0.0), 0.2)


@pytest.mark.parametrize(("text", "number"), [(".5", 0.5), ("-.5e1", -5.0), ("+2", 2.0), ("3.", 3.0), (" 007 ", 7.0)])
def test_numbers_are_taken_as_people_write_them(hqmodel: Command, opened: list[Any], text: str, number: float) -> None:
    assert hqmodel("ball.json", "--set", f"slice={text}").status == 0
    assert opened[0][1](load("ball.json")).slice == number


def test_later_changes_win(hqmodel: Command, opened: list[Any]) -> None:
    hqmodel("ball.json", "--slice", 1, "--set", "slice=2", "--set", "gamma=3", "--set", "shapes[0].strips[1].gamma=4")
    scene = opened[0][1](load("ball.json"))
    assert scene.slice == 2.0
    assert [strip.gamma for strip in scene.shapes[0].strips] == [3.0, 4.0, 3.0]


OSERRORS = [
    (OSError(errno.ENOSPC, "No space left on device", "a.obj"), 3, "a.obj: No space left on device"),
    (MemoryError(), 3, "not enough memory for this; a smaller --resolution or --size needs less"),
    (KeyboardInterrupt(), 130, "interrupted"),
    (ZeroDivisionError("odd\nthing"), 70, "hqmodel has a fault: ZeroDivisionError: odd thing (HQMODEL_DEBUG=1 shows where)"),
]


@pytest.mark.parametrize(("error", "status", "message"), OSERRORS, ids=lambda value: type(value).__name__)
def test_whatever_happens_ends_in_one_line(
    hqmodel: Command, monkeypatch: pytest.MonkeyPatch, error: BaseException, status: int, message: str
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr("hqmodel.mesh.polygonize", fail)
    assert hqmodel("export", "ball.json", "-o", "a.obj") == Ended(status, "", message + "\n")
    assert files() == {"ball.json"}


def test_unknown_names_are_told_with_what_comes_close(hqmodel: Command) -> None:
    Path("presets.json").write_text(json.dumps(BALL))
    ended = hqmodel("render", "no such preset", "-o", "a.png")
    assert (ended.status, ended.out) == (1, "")
    assert one_line(ended.err).startswith("no such preset: expected a preset file or a built-in preset's name")
