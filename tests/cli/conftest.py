"""The command line run in this process, and presets to run it on."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from hqmodel.cli import run

BALL: dict[str, Any] = {
    "format": "hqmodel",
    "version": 1,
    "name": "Ball",
    "shapes": [{"strips": [{"normal": [1, 0, 0]}, {"normal": [0, 1, 0]}, {"normal": [0, 0, 1]}]}],
}


class Ended(NamedTuple):
    status: int
    out: str
    err: str


Command = Callable[..., Ended]


@pytest.fixture
def hqmodel(capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Command:
    """Runs a command line in an empty folder that holds `ball.json`."""
    monkeypatch.chdir(tmp_path)
    Path("ball.json").write_text(json.dumps(BALL))

    def command(*arguments: object) -> Ended:
        capsys.readouterr()
        status = run([str(argument) for argument in arguments])
        return Ended(status, *capsys.readouterr())

    return command


def files() -> set[str]:
    """What lies in the working folder."""
    return {path.name for path in Path().iterdir()}
