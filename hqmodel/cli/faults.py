"""How a run can end, and how each way is told: one line on stderr and an exit status, never a traceback."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from errno import EDQUOT, EFBIG, EIO, ENOSPC, EROFS

import typer

from hqmodel.files import PresetError

DONE = 0
INPUT = 1  # the input is at fault
USAGE = 2  # the command line is
MACHINE = 3  # the machine lacks something
BUG = 70  # the program is (EX_SOFTWARE in sysexits.h)
INTERRUPTED = 130

# Set, it lets an unexpected error through with its traceback.
DEBUG = "HQMODEL_DEBUG"

# typer brings its own copy of click from some version on; its public exception leads to the right one.
_UsageError = typer.BadParameter.__mro__[1]


class Fault(Exception):
    """The run is over: one line for stderr, and the exit status."""

    def __init__(self, message: str, status: int = INPUT) -> None:
        super().__init__(message)
        self.status = status


def unwritable(path: object, error: OSError) -> Fault:
    """What to say of an output file that could not be written: the machine's fault when the disk is, else the command line's."""
    status = MACHINE if error.errno in (ENOSPC, EDQUOT, EFBIG, EIO, EROFS) else USAGE
    return Fault(f"{path}: expected a file that can be written, got: {error.strerror or error}", status)


def guarded(work: Callable[[], None]) -> int:
    """Do the work; whatever goes wrong is told on stderr, and the exit status says whose fault it was."""
    try:
        status = _finished(work)
        if sys.stdout is not None:  # it is where the program was started with its output closed
            sys.stdout.flush()
        return status
    except KeyboardInterrupt:
        return _told("interrupted", INTERRUPTED)
    except BrokenPipeError:
        return _hung_up()
    except Exception as error:
        if os.environ.get(DEBUG):
            raise
        return _told(*_verdict(error))


def _finished(work: Callable[[], None]) -> int:
    """Do the work; it may end early with a status of its own."""
    try:
        work()
    except typer.Exit as end:
        return end.exit_code
    return DONE


def _verdict(error: Exception) -> tuple[str, int]:
    """The line and the exit status for an error."""
    if isinstance(error, Fault):
        return str(error), error.status
    if isinstance(error, PresetError):
        return error.headline, INPUT
    if isinstance(error, _UsageError):
        return _usage(error), USAGE
    if isinstance(error, MemoryError):
        return "not enough memory for this; a smaller --resolution or --size needs less", MACHINE
    if isinstance(error, OSError):
        return f"{error.filename or 'output'}: {error.strerror or error}", MACHINE
    return f"hqmodel has a fault: {type(error).__name__}: {error} ({DEBUG}=1 shows where)", BUG


def _usage(error: Exception) -> str:
    context = getattr(error, "ctx", None)
    message = error.format_message() if hasattr(error, "format_message") else str(error)
    command = context.command_path if context else "hqmodel"
    return f"{command}: {message.rstrip('.')} (see {command} --help)"


def _told(message: str, status: int) -> int:
    line = " ".join(part.strip() for part in message.splitlines())
    print(line, file=sys.stderr, flush=True)
    return status


def _hung_up() -> int:
    """Whoever read our output wants no more: nobody is left to tell, and what is still buffered goes nowhere."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return DONE
