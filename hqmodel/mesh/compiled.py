"""Loops that Numba compiles: what NumPy would need many passes for, and what two threads are to do at once.

Numba is loaded, and a loop compiled, with its first call. What is compiled is kept beside the package or, where that is
read-only, in the user's own cache. Compiling takes some three seconds once, then loading a third of one.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import wraps
from threading import Lock
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")
_one_at_a_time = Lock()


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """The function, compiled for the types of its arguments; it lets go of Python's lock."""
    made: list[Callable[P, R]] = []

    @wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        if not made:
            with _one_at_a_time:
                made.append(_made(function))
        return made[0](*args, **kwargs)

    return call


def _made(function: Callable[P, R]) -> Callable[P, R]:
    import numba  # late: it takes a third of a second

    jitted: Callable[P, R] = numba.njit(nogil=True, error_model="numpy")(function)
    with suppress(RuntimeError):  # where no folder may be written to, every process compiles anew
        jitted.enable_caching()  # type: ignore[attr-defined]  # a dispatcher's
    return jitted
