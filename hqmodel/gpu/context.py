"""The OpenGL context: off screen through EGL where there is one, else through the platform's own way."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

import moderngl

# What macOS offers at most is 4.1; the shaders ask for no more than 3.3.
REQUIRED = 330
_ADVICE = (
    "OpenGL 3.3 is needed and was not found: install the graphics driver, "
    "or Mesa's software renderer (on Debian and Ubuntu: libegl1 and libgl1-mesa-dri)"
)


class GpuError(Exception):
    """The machine lacks OpenGL, or what it has is not enough; the message says what to install."""


def offscreen() -> moderngl.Context:
    """A context without a window.

    Raises GpuError, one sentence, when no way leads to OpenGL 3.3.
    """
    reasons = []
    ways: tuple[dict[str, Any], ...] = ({"backend": "egl"}, {})
    for options in ways:
        try:
            return moderngl.create_context(standalone=True, require=REQUIRED, **options)
        except Exception as error:  # moderngl's backends raise the bare Exception, ImportError, OSError or ValueError
            reasons.append(" ".join(str(error).split()) or type(error).__name__)
    raise GpuError(f"{_ADVICE} ({'; '.join(reasons)})")


def must_be_sound(ctx: moderngl.Context) -> None:
    """Raise GpuError where OpenGL has failed since this was asked last: a lost context draws nothing, and is silent."""
    error = ctx.error
    if error != "GL_NO_ERROR":
        raise GpuError(f"OpenGL has failed ({error}): the graphics driver was reset, or has a fault; start the program again")


@contextmanager
def framebuffer_kept(ctx: moderngl.Context) -> Iterator[None]:
    """Whatever framebuffer is bound now is bound again afterwards: releasing a bound one would leave later calls in error."""
    before = ctx.detect_framebuffer()
    try:
        yield
    finally:
        ctx.enable_only(moderngl.NOTHING)
        before.use()


@contextmanager
def undisturbed() -> Iterator[None]:
    """Requests to end that come meanwhile are heeded afterwards.

    Making a program, moderngl calls back into Python, and the process crashes where a signal's handler raises there.
    """
    if threading.current_thread() is not threading.main_thread():
        yield  # signals are another thread's
        return
    came: list[int] = []

    def note(number: int, frame: FrameType | None) -> None:
        came.append(number)

    handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    handlers = {number: handler for number, handler in handlers.items() if callable(handler)}
    for number in handlers:
        signal.signal(number, note)
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
    if came:
        signal.raise_signal(came[0])
