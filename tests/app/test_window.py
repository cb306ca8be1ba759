"""The real window, driven by ImGui's test engine from inside and by xdotool from outside."""

from __future__ import annotations

import re
import subprocess
import sys
import time
from pathlib import Path

import pytest

from hqmodel import files
from hqmodel.app.display import LOST
from hqmodel.app.view import restored
from hqmodel.edit import new_scene
from hqmodel.model import Camera

from .outside import ROOT, SECONDS, Outside, surroundings

SCENARIOS = [
    f"{module.stem}:{name}"
    for module in sorted(Path(__file__).parent.glob("scenarios*.py"))
    for name in re.findall(r"^def (\w+)\(hands: Hands\) -> None:", module.read_text(), re.MULTILINE)
]


def test_there_are_scenarios() -> None:
    assert len(SCENARIOS) >= 8


@pytest.mark.parametrize("name", SCENARIOS)
def test_scenario(name: str, display: str, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "tests.app.drive", f"tests.app.{name}", str(tmp_path)]
    environment = surroundings(display, tmp_path)
    ended = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=SECONDS)
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_when_drawing_itself_fails_the_work_is_kept(display: str, tmp_path: Path) -> None:
    """Nothing guards this one: the program ends, with the fault and with the file that has what was not saved."""
    code = """
from hqmodel.app.intents import Do
from hqmodel.app.session import Session
from hqmodel.app.window import Window
from hqmodel.files import Settings

session = Session(Settings())
session.apply([Do("add block")])
window = Window(session)

def failing():
    raise MemoryError("a fault of ours")

window.params.callbacks.pre_new_frame = failing
window.run()
"""
    environment = surroundings(display, tmp_path)
    ended = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, timeout=SECONDS)
    assert ended.returncode == 1
    assert "MemoryError: a fault of ours" in ended.stderr
    kept = re.search(r"^hqmodel: what was not saved is in (.+)$", ended.stderr, re.MULTILINE)
    assert kept is not None
    assert [shape.name for shape in files.load(kept[1]).shapes] == ["Ball", "Block"]


def test_when_the_driver_is_reset_the_work_is_kept(display: str, tmp_path: Path) -> None:
    """As it says itself: nothing is seen of what is drawn from then on."""
    code = """
import sys
from hqmodel.app import display
from hqmodel.cli import run
answers = iter([False, True])
display.loss_of = lambda window: lambda: next(answers)
sys.exit(run(["edit", "soft-die", "--set", "level=0.5"]))
"""
    environment = surroundings(display, tmp_path)
    ended = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, timeout=SECONDS)
    assert ended.returncode == 3
    kept, told = ended.stderr.splitlines()
    assert told == LOST
    assert files.load(kept.removeprefix("hqmodel: what was not saved is in ")).level == 0.5


def test_a_home_that_cannot_be_written_to_is_no_error(display: str, tmp_path: Path) -> None:
    """Files stand where the folders for settings, copies and pictures would be: not even root can write there."""
    for name in ("config", "state", "cache"):
        (tmp_path / name).write_text("in the way")
    command = [sys.executable, "-m", "tests.app.drive", "tests.app.scenarios:turns_and_resets", str(tmp_path)]
    environment = surroundings(display, tmp_path)
    ended = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=SECONDS)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert (tmp_path / "config").read_text() == "in the way"


def test_without_a_display_it_says_so_in_one_sentence(tmp_path: Path) -> None:
    environment = {**surroundings("", tmp_path), "WAYLAND_DISPLAY": ""}
    code = "from hqmodel.app import NoDisplay, run\ntry:\n    run()\nexcept NoDisplay as error:\n    print(error)"
    ended = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, timeout=SECONDS)
    assert ended.stderr == ""
    assert len(ended.stdout.splitlines()) == 1
    assert "display" in ended.stdout
    assert "hqmodel export" in ended.stdout


def test_from_outside_a_drag_turns_the_view_and_keys_work(display: str, tmp_path: Path) -> None:
    preset = tmp_path / "outside.json"
    scene = new_scene()
    files.save(scene, preset)
    window = Outside(display, tmp_path, preset)
    try:
        assert window.title() == "outside - hqmodel"
        window.tool("key", "ctrl+d")
        window.until(lambda: window.title() == "outside* - hqmodel")
        window.tool("key", "ctrl+z")
        window.until(lambda: window.title() == "outside - hqmodel")
        window.tool("mousemove", "600", "600", "mousedown", "1")  # beside the body
        for x in range(600, 700, 20):
            window.tool("mousemove", str(x), "600")
            time.sleep(0.1)
        window.tool("mouseup", "1")
        window.tool("key", "ctrl+s")
        window.until(lambda: files.load(preset).view)
        view = restored(files.load(preset).view)
        assert view is not None
        assert view.camera.azimuth != Camera().azimuth
        assert view.camera.elevation == Camera().elevation
        assert files.load(preset).shapes == scene.shapes
        window.tool("key", "ctrl+q")
        assert window.process.wait(SECONDS) == 0
    finally:
        window.end()
