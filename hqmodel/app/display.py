"""Whether a window can be opened here at all, asked before anything of the window is built."""

from __future__ import annotations

import ctypes
import sys
import warnings
from collections.abc import Callable
from typing import Any

LOST = "the graphics driver was reset, which the window does not survive; start hqmodel again"
HEADLESS = "`hqmodel export`, `render`, `sample`, `raycast`, `check` and `presets` work without one"


class NoDisplay(Exception):
    """The machine lacks what a window needs; the message says what, and what works without."""


def require() -> float:
    """The screen's scale, as far as hello_imgui does not find it by itself.

    Raises NoDisplay, with one sentence, where no window with OpenGL 3.3 can be opened.
    """
    import imgui_bundle  # noqa: F401  it comes first: it tells glfw which library the two share

    # isort: split
    import glfw

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", glfw.GLFWError)  # glfw reports as warnings what is raised here
        if not glfw.init():
            raise NoDisplay(f"no display to open a window on ({_where()}); {HEADLESS}")
        try:
            return _probe()
        finally:
            glfw.terminate()


def ask_to_be_told() -> None:
    """Have the next window's OpenGL tell when the driver has lost it; one that can't takes no notice."""
    import glfw

    glfw.init()  # which hello_imgui's own call leaves as it is, hints and all
    glfw.window_hint(glfw.CONTEXT_ROBUSTNESS, glfw.LOSE_CONTEXT_ON_RESET)


def loss_of(window: Any) -> Callable[[], bool]:
    """What says whether the driver has lost the OpenGL of a window, which must be current: never, where it would not tell."""
    import glfw

    if glfw.get_window_attrib(window, glfw.CONTEXT_ROBUSTNESS) != glfw.LOSE_CONTEXT_ON_RESET:
        return lambda: False
    address: Any = glfw.get_proc_address("glGetGraphicsResetStatusARB")
    status = ctypes.CFUNCTYPE(ctypes.c_uint)(address)
    return lambda: status() != 0


def _probe() -> float:
    """Opens a window that is never shown, with the OpenGL that the modeller asks for; the scale of letters on it.

    X11 counts in pixels and leaves the scale to programs; elsewhere the system or hello_imgui sees to it.
    """
    import glfw

    ask_to_be_told()
    for hint, value in ((glfw.VISIBLE, False), (glfw.CONTEXT_VERSION_MAJOR, 3), (glfw.CONTEXT_VERSION_MINOR, 3)):
        glfw.window_hint(hint, value)
    if sys.platform == "darwin":
        glfw.window_hint(glfw.OPENGL_FORWARD_COMPAT, True)
    glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)
    window = glfw.create_window(16, 16, "hqmodel", None, None)
    if not window:
        raise NoDisplay(
            "the display has no OpenGL 3.3: install the graphics driver, "
            f"or Mesa (libgl1-mesa-dri) for the software one; {HEADLESS}"
        )
    scale = glfw.get_window_content_scale(window)[0]
    counted = glfw.get_framebuffer_size(window)[0] == glfw.get_window_size(window)[0]
    glfw.destroy_window(window)
    return max(scale, 1.0) if counted and sys.platform.startswith("linux") else 1.0


def _where() -> str:
    return "set DISPLAY or WAYLAND_DISPLAY" if sys.platform.startswith("linux") else "no desktop session"
