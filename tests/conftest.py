"""How the suite runs: no deadline on examples, settings kept out of the home, and a display of its own for the window tests."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

settings.register_profile("hqmodel", deadline=None, max_examples=40, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("hqmodel")


@pytest.fixture(autouse=True)
def _own_settings(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Each test has empty folders for what the program keeps."""
    folder: Path = tmp_path_factory.mktemp("home")
    for name in ("config", "state", "cache"):
        monkeypatch.setenv(f"XDG_{name.upper()}_HOME", str(folder / name))
    yield


@pytest.fixture(scope="session", autouse=True)
def _shaders_kept(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Mesa keeps the shaders that it has compiled, for the whole run: homes that are new would have every test compile them."""
    folder: Path = tmp_path_factory.getbasetemp()
    os.environ["MESA_SHADER_CACHE_DIR"] = str(folder.parent if "PYTEST_XDIST_WORKER" in os.environ else folder)


@pytest.fixture(scope="session")
def display() -> Iterator[str]:
    """The name of a display to open windows on; each of the suite's processes has one to itself."""
    if shutil.which("Xvfb") is None:
        pytest.fail("the window tests need a display: install Xvfb (on Debian and Ubuntu: xvfb)")
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-nolisten", "tcp", "-noreset"]
    with subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL) as server:
        os.close(write)
        with os.fdopen(read) as stream:
            number = stream.readline().strip()
        if not number:
            pytest.fail("Xvfb ended without opening a display: run it by hand to see why")
        yield f":{number}"
        server.terminate()
