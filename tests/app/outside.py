"""The modeller's window as somebody at the machine has it: a process, a title, a mouse and a keyboard, by xdotool."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

T = TypeVar("T")
ROOT = Path(__file__).parents[2]
SECONDS = 240
# How long to wait for something to come of what was done.
PATIENCE = 60


def surroundings(display: str, folder: Path) -> dict[str, str]:
    """The window's environment: its settings and all that it writes stay in the test's folder, Mesa draws."""
    folders = {f"XDG_{name}_HOME": str(folder / name.lower()) for name in ("CONFIG", "STATE", "CACHE", "DATA")}
    paths = os.pathsep.join([str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])])
    return {**os.environ, **folders, "HOME": str(folder), "DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1", "PYTHONPATH": paths}


# Where the viewport is, in pixels of the screen, is written down in each frame: x, y, width, height.
_NOTING = """
from pathlib import Path
from imgui_bundle import imgui
from hqmodel.app import run
from hqmodel.app.panels import viewport
drawn = viewport.draw
def noting(*arguments):
    corner, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
    Path({place!r}).write_text(f"{{corner.x}} {{corner.y}} {{room.x}} {{room.y}}")
    return drawn(*arguments)
viewport.draw = noting
run(Path({preset!r}))
"""


class Outside:
    """The window as somebody at the machine has it: a process, a title, a mouse and a keyboard."""

    def __init__(self, display: str, folder: Path, preset: Path) -> None:
        self.environment = surroundings(display, folder)
        assert shutil.which("xdotool"), "this test needs xdotool: install it (on Debian and Ubuntu: xdotool)"
        self._place = folder / "viewport.txt"
        code = _NOTING.format(place=str(self._place), preset=str(preset))
        self.process = subprocess.Popen([sys.executable, "-c", code], env=self.environment, cwd=folder)
        self.window = self.until(lambda: self.tool("search", "--onlyvisible", "--name", " - hqmodel$")).split()[0]
        self.tool("windowmove", self.window, "0", "0")
        self.tool("windowfocus", "--sync", self.window)

    def tool(self, *arguments: str) -> str:
        """What xdotool says; empty where it finds nothing."""
        command = ["xdotool", *arguments]
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, timeout=SECONDS).stdout.strip()

    def title(self) -> str:
        return self.tool("getwindowname", self.window)

    @property
    def viewport(self) -> tuple[float, float, int, int]:
        """Where the viewport is: left, top, width, height."""
        x, y, width, height = map(float, self.until(lambda: self._place.read_text() if self._place.exists() else "").split())
        return x, y, int(width), int(height)

    def keys(self, *keys: str) -> None:
        """Press keys, as xdotool names them, one after the other."""
        for key in keys:
            self.tool("key", key)
            time.sleep(0.05)

    def drag(self, start: tuple[float, float], *steps: tuple[float, float], holding: Callable[[], None] | None = None) -> None:
        """Press at a pixel of the viewport, move by these steps, and let go; `holding` is done before that."""
        left, top, _, _ = self.viewport
        x, y = left + start[0], top + start[1]
        self.tool("mousemove", str(round(x)), str(round(y)))
        time.sleep(0.3)
        self.tool("mousedown", "1")
        for dx, dy in steps:
            x, y = x + dx, y + dy
            time.sleep(0.15)
            self.tool("mousemove", str(round(x)), str(round(y)))
        time.sleep(0.3)
        if holding is not None:
            holding()
        self.tool("mouseup", "1")
        time.sleep(0.2)

    def end(self) -> None:
        self.process.kill()
        self.process.wait()

    def until(self, condition: Callable[[], T]) -> T:
        """What the condition gives as soon as it gives something."""
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            assert self.process.poll() is None, "the window has closed"
            found = condition()
            if found:
                return found
            time.sleep(0.1)
        raise AssertionError(f"waited {PATIENCE} seconds in vain; the title says {self.title()!r}")
