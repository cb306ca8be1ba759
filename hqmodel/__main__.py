"""The program's entry: ``python -m hqmodel`` and the console's commands."""

from __future__ import annotations

import signal
import sys


def main() -> None:
    """The console's: the command line."""
    _load()
    from hqmodel.cli import run

    sys.exit(run(sys.argv[1:]))


def main_window() -> None:
    """Desktops', which open a file by naming it: what is wrong with it is told in the window."""
    _load()
    from pathlib import Path

    from hqmodel.cli import open_window

    sys.exit(open_window(Path(sys.argv[1]) if len(sys.argv) > 1 else None))


def _load() -> None:
    """Load the command line, which takes most of a second: until then nothing needs clearing up, and Ctrl-C just ends it all."""
    handler = signal.getsignal(signal.SIGINT)
    if handler is signal.default_int_handler:  # else whoever started it wants Ctrl-C ignored
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    import hqmodel.cli  # noqa: F401

    signal.signal(signal.SIGINT, handler)
    signal.signal(signal.SIGTERM, _terminated)


def _terminated(number: int, _: object) -> None:
    """Asked to end: unwind, so that nothing half-written is left behind."""
    sys.exit(128 + number)


if __name__ == "__main__":
    main()
