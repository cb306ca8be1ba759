"""Runs the modeller's real window with a function that drives it through ImGui's test engine; a process of its own.

``python -m tests.app.drive MODULE:FUNCTION FOLDER [PRESET]`` calls ``FUNCTION(hands)``; where that fails it exits with 1 and the
traceback.
"""

from __future__ import annotations

import sys
import traceback
from importlib import import_module
from pathlib import Path
from typing import Any

from imgui_bundle import hello_imgui, imgui

from hqmodel.app.session import Session
from hqmodel.app.window import Window
from hqmodel.files import Settings

engine = imgui.test_engine
# Small enough for a software renderer to be quick with.
SIZE = 880, 600


class Hands:
    """What a test needs to work the window: the test engine's context, the window, its session, and a folder for files."""

    def __init__(self, ctx: Any, window: Window, folder: Path) -> None:
        self.ctx = ctx
        self.window = window
        self.folder = folder

    @property
    def session(self) -> Session:
        return self.window.session

    def wait(self, condition: Any, frames: int = 600) -> None:
        """Draw frames until the condition holds; an error when it never does."""
        for _ in range(frames):
            if condition():
                return
            self.ctx.yield_()
        raise AssertionError(f"waited {frames} frames in vain")

    def settle(self, frames: int = 2) -> None:
        self.ctx.yield_(frames)

    def keys(self, chord: int) -> None:
        self.ctx.key_press(chord)
        self.settle()

    def click(self, item: str) -> None:
        """Click an item; a failure of the engine's is one of the test."""
        self.ctx.item_click(item)
        self.settle()
        self.check(item)

    def type_value(self, item: str, value: float | str) -> None:
        """Ctrl+click, type, Enter."""
        self.ctx.item_input_value(item, value)
        self.settle()
        self.check(item)

    def drag(self, item: str, dx: float, dy: float = 0.0) -> None:
        self.ctx.item_drag_with_delta(item, (dx, dy))
        self.settle()
        self.check(item)

    def menu(self, path: str) -> None:
        self.ctx.menu_click(f"//##MainMenuBar/{path}")
        self.settle()
        self.check(path)

    def check(self, what: str) -> None:
        assert not self.ctx.is_error(), f"the test engine could not do: {what}"

    def shoot(self, name: str) -> None:
        """The window as a picture, in the folder."""
        self.settle(2)
        self.ctx.capture_reset()
        self.ctx.capture_set_filename(str(self.folder / f"{name}.png"))
        assert self.ctx.capture_screenshot(), "no screenshot"


def main(target: str, folder: Path, preset: Path | None = None) -> int:
    """0 where the function passed."""
    from hqmodel.app.asks import Open

    module, name = target.split(":")
    function = getattr(import_module(module), name)
    session = Session(Settings.read().preferring(refining=False))  # drafts will do, and leave the time to the test
    if preset is not None:
        session.apply([Open(preset)])
    window = Window(session, native_dialogs=False)
    # Its thumbnails would take most of the time.
    window.params.docking_params.dockable_window_of_name("Presets").is_visible = False
    failures = ["the function never ended"]

    def drive(ctx: Any) -> None:
        try:
            function(Hands(ctx, window, folder))
            failures.clear()
        except BaseException:
            failures[:] = [traceback.format_exc()]
        session.history.mark_saved()
        session.finished = True

    def register() -> None:
        test_engine = hello_imgui.get_imgui_test_engine()
        io = engine.get_io(test_engine)
        io.config_run_speed = engine.TestRunSpeed.fast
        io.config_log_to_tty = True
        io.config_watchdog_warning = io.config_watchdog_kill_test = 86400.0  # who started this process says how long it may take
        io.config_fixed_delta_time = 1 / 60  # a double click stays one on a machine that is busy
        test = engine.register_test(test_engine, "hqmodel", name)
        test.test_func = drive
        engine.queue_test(test_engine, test)

    window.params.use_imgui_test_engine = True
    window.params.callbacks.register_tests = register
    window.params.fps_idling.enable_idling = False
    window.params.app_window_params.window_geometry.size = SIZE
    window.run()
    for failure in failures:
        print(failure, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], Path(sys.argv[2]), *map(Path, sys.argv[3:])))
