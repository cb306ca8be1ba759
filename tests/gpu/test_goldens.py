"""Every mode and material looks as it did when it was last looked at."""

from __future__ import annotations

from pathlib import Path

import moderngl
import numpy as np
import pytest
from PIL import Image

from .goldens import FOLDER, PICTURES

# Levels of 255: on average, and what a few pixels (at edges, where renderers round differently) may be more apart than.
_MEAN, _APART, _SHARE = 0.7, 14, 0.01


@pytest.mark.parametrize("name", PICTURES)
def test_it_looks_as_it_did(ctx: moderngl.Context, tmp_path: Path, name: str) -> None:
    drawn = PICTURES[name](ctx)[..., :3].astype(int)
    with Image.open(FOLDER / f"{name}.png") as golden:
        expected = np.asarray(golden).astype(int)
    assert drawn.shape == expected.shape
    apart = np.abs(drawn - expected)
    if np.mean(apart) > _MEAN or np.mean(np.max(apart, axis=2) > _APART) > _SHARE:
        shown = np.concatenate([expected, drawn, np.minimum(8 * apart, 255)], axis=1).astype(np.uint8)
        Image.fromarray(shown).save(tmp_path / f"{name}.png")
        pytest.fail(f"off by {np.mean(apart):.2f} on average; expected, drawn and 8 times the difference: {tmp_path / name}.png")


def test_every_golden_is_drawn() -> None:
    assert {path.stem for path in FOLDER.iterdir()} == set(PICTURES)
