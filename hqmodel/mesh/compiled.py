"""Loops that Numba compiles: what NumPy would need many passes for, and what two threads are to do at once.

Numba is loaded, and a loop compiled, with its first call. What is compiled is kept beside the package or, where that is
read-only, in the user's own cache.
"""

from __future__ import annotations

from collections.abc import Callable
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
                import numba  # late: it takes a third of a second

                made.append(numba.njit(nogil=True, cache=True, error_model="numpy")(function))
        return made[0](*args, **kwargs)

    return call
