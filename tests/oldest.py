"""Prints the oldest versions of what the package depends on, as pip wants them: numpy==1.26 and so on."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path


def oldest() -> list[str]:
    """Each dependency at the lower end of its range."""
    project = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text())["project"]
    return [re.sub(r">=([\d.]+).*", r"==\1", dependency) for dependency in project["dependencies"]]


if __name__ == "__main__":
    print(*oldest())
