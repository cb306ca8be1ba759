"""Presets from strangers: whatever is in the file, it is a scene or a PresetError, in bounded time and memory."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from .mutants import CORPUS, outcome

ROOT = Path(__file__).parents[2]
COUNT = 800


def test_the_corpus_is_read_or_refused_for_faults_of_many_kinds() -> None:
    assert len({outcome(path.read_bytes()) for path in CORPUS.glob("*.json")}) > 30


def test_damaged_presets_are_read_or_refused_in_little_memory() -> None:
    command = [sys.executable, "-m", "tests.reliability.mutants", str(COUNT), "7"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    assert (done.returncode, done.stderr) == (0, "")
    told = json.loads(done.stdout)
    assert told["read"] == COUNT
    assert told["scenes"] > COUNT / 20
    assert told["kinds of faults"] > COUNT / 4
