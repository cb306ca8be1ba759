"""Older versions become newer ones, a version at a time."""

from __future__ import annotations

from typing import Any

import pytest

from hqmodel.files.migrate import MIGRATIONS, migrated, unreadable
from hqmodel.model import VERSION

Tree = dict[str, Any]


def renamed(old: str, new: str) -> Any:
    return lambda tree: {new if key == old else key: value for key, value in tree.items()}


STEPS = {1: renamed("a", "b"), 2: renamed("b", "c")}


@pytest.mark.parametrize(("version", "key"), [(1, "a"), (2, "b"), (3, "c")])
def test_each_older_version_takes_every_step_to_the_newest(version: int, key: str) -> None:
    tree = {"format": "hqmodel", "version": version, key: 5, "own": "kept"}
    assert unreadable(tree, newest=3) is None
    assert migrated(tree, STEPS, newest=3) == {"format": "hqmodel", "version": 3, "c": 5, "own": "kept"}


def test_there_is_a_step_from_every_older_version() -> None:
    assert set(MIGRATIONS) == set(range(1, VERSION))


def test_a_newer_version_is_refused() -> None:
    reason = unreadable({"format": "hqmodel", "version": 4}, newest=3)
    assert reason == "version: expected at most 3, got 4: a newer hqmodel saved this preset, update to open it"
