"""The command line, one small file a command."""

from .main import open_window, run

__all__ = ["open_window", "run"]
