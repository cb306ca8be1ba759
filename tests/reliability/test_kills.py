"""Killed at any system call of a save or an export: the old file or the new one is there, whole, and nothing piles up."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
OTHERS = ["save_through_a_link", "save_with_backup", "save_new", "autosave"]


# In the suite one save is killed at every call, all else at some; `make reliability` kills all at every one.
@pytest.mark.parametrize(("works", "every", "least"), [(["save_over"], 1, 50), (OTHERS, 9, 5), (["export", "fitted"], 40, 2)])
def test_killed_at_a_system_call(tmp_path: Path, works: list[str], every: int, least: int) -> None:
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}  # no threads, so that it may fork
    command = [sys.executable, "-m", "tests.reliability.kills", str(tmp_path), str(every), *works]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment, cwd=ROOT)
    assert (done.returncode, done.stderr) == (0, "")
    kills = json.loads(done.stdout)
    assert list(kills) == works
    assert min(kills.values()) >= least
