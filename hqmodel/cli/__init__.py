"""The command line, one small file a command."""

from .main import main, main_window, run

__all__ = ["main", "main_window", "run"]
