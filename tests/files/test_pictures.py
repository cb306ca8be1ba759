"""Pictures kept between runs: found again for the same file and version only, and never in the way."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from hqmodel.files import Pictures
from hqmodel.files.pictures import PICTURES

PIXELS = np.random.default_rng(7).integers(0, 256, (16, 16, 4), np.uint8)


def folder() -> Path:
    return Path(os.environ["XDG_CACHE_HOME"]) / "hqmodel" / "thumbnails"


def test_a_picture_is_found_for_the_same_bytes_and_version() -> None:
    Pictures("1").keep(b"a", PIXELS)
    found = Pictures("1").find(b"a")
    assert found is not None
    assert np.array_equal(found, PIXELS)
    assert Pictures("1").find(b"b") is None
    assert Pictures("2").find(b"a") is None


def test_a_damaged_picture_is_none() -> None:
    Pictures("1").keep(b"a", PIXELS)
    (path,) = folder().iterdir()
    for damage in (b"", b"\x89PNG\r\n\x1a\n", path.read_bytes()[:-30]):
        path.write_bytes(damage)
        assert Pictures("1").find(b"a") is None


def test_those_longest_unused_go() -> None:
    folder().mkdir(parents=True)
    for number in range(PICTURES):
        (folder() / f"{number}.png").touch()
        os.utime(folder() / f"{number}.png", (number, number))
    Pictures("1").keep(b"a", PIXELS)
    assert len(list(folder().iterdir())) == PICTURES
    assert not (folder() / "0.png").exists()
    assert Pictures("1").find(b"a") is not None


def test_where_nothing_can_be_written_nothing_happens(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    Pictures("1").keep(b"a", PIXELS)
    assert Pictures("1").find(b"a") is None
