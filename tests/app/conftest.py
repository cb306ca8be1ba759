"""A display for the window tests: an Xvfb of their own, so that no other window takes the keys meant for theirs.

Without Xvfb they fail, and say what to install.
"""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterator

import pytest


@pytest.fixture(scope="session")
def display() -> Iterator[str]:
    """The name of a display to open windows on; each of the suite's processes has one to itself."""
    if shutil.which("Xvfb") is None:
        pytest.fail("the window tests need a display: install Xvfb (on Debian and Ubuntu: xvfb)")
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-nolisten", "tcp"]
    with subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL) as server:
        os.close(write)
        with os.fdopen(read) as stream:
            number = stream.readline().strip()
        if not number:
            pytest.fail("Xvfb ended without opening a display: run it by hand to see why")
        yield f":{number}"
        server.terminate()
