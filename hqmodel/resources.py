"""Where the program's own data lies: beside the package in a checkout, inside it in an installed wheel."""

from __future__ import annotations

from pathlib import Path


def folder(name: str) -> Path:
    """The folder `shaders` or `presets`.

    Raises FileNotFoundError when the installation lacks it.
    """
    package = Path(__file__).parent
    for candidate in (package / name, package.parent / name):
        if candidate.is_dir():
            return candidate
    raise FileNotFoundError(f"this installation of hqmodel lacks its folder {name!r}: install it again")
