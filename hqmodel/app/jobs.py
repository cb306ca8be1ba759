"""Long work in the background: a thread of its own, progress to look at, and a way to stop it that leaves nothing behind."""

from __future__ import annotations

import threading
import traceback
from abc import ABC, abstractmethod
from collections.abc import Callable
from time import monotonic
from typing import Generic, TypeVar

from .asks import Problem

T = TypeVar("T")
# The share that must be done before the rest can be judged by it.
_TELLING = 0.08


class Cancelled(BaseException):
    """Raised inside the work by its own progress reports; no `except Exception` on the way may swallow it."""


class Job(ABC, Generic[T]):
    """`progress` and `stage` say how far it is; `outcome` is set when it has ended, None where it was cancelled.

    `noun` names it for people, `aftermath` says what came of it when it was cancelled. `wake` is called, from the job's thread,
    whenever there is something new to show.
    """

    noun: str
    aftermath: str

    def __init__(self, wake: Callable[[], None] = lambda: None) -> None:
        self.progress = 0.0
        self.stage = "Starting"
        self.outcome: T | Problem | None = None
        self.cancelled = False
        self._wake = wake
        self._started = monotonic()
        self._thread = threading.Thread(target=self._run, name=self.noun, daemon=True)
        self._thread.start()

    @abstractmethod
    def _work(self) -> T:
        """Do it, and tell `_report` often."""

    @abstractmethod
    def _place(self) -> str:
        """What the work is about, for what it says when it fails."""

    @property
    def running(self) -> bool:
        return self._thread.is_alive()

    @property
    def remaining(self) -> float | None:
        """Seconds that it will take yet, going by what is done; None where that can't be said."""
        if self.progress < _TELLING:
            return None
        return (monotonic() - self._started) * (1 - self.progress) / self.progress

    def cancel(self) -> None:
        """Stop at the next report of progress; what was there before stays as it was."""
        self.cancelled = True

    def wait(self, seconds: float | None = None) -> None:
        """Until it has ended."""
        self._thread.join(seconds)

    def _run(self) -> None:
        title = f"{self.noun} failed"
        try:
            self.outcome = self._work()
        except Cancelled:
            pass  # asked for; an outcome would only be in the way
        except self._faults() as error:
            self.outcome = Problem(title, (str(error),))
        except OSError as error:
            self.outcome = Problem(title, (f"{self._place()}: {error.strerror or error}",))
        except Exception:  # a fault of ours must reach the screen, not die with the thread
            self.outcome = Problem(title, ("This should not have happened; your work is untouched.", *_lines()))
        finally:
            self._wake()

    @abstractmethod
    def _faults(self) -> type[Exception] | tuple[type[Exception], ...]:
        """What the work raises, with one line, where its input is at fault."""

    def _report(self, progress: float, stage: str) -> None:
        if self.cancelled:
            raise Cancelled
        self.progress, self.stage = progress, stage
        self._wake()


def _lines() -> tuple[str, ...]:
    return tuple(traceback.format_exc().strip().splitlines()[-3:])
