"""The reference cases: presets with what is true of them, worked out by a program independent of this one."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hqmodel.model import Scene

FOLDER = Path(__file__).parent / "reference"
NAMES = sorted(path.stem for path in FOLDER.glob("*.json"))


class Case(NamedTuple):
    """A preset and its truths; `rows` turns a list of records into an array."""

    scene: Scene
    truth: dict[str, Any]

    def rows(self, table: str, key: str) -> NDArray[np.float64]:
        """One column of `rays`, `surface_points` or `samples`; NaN where there is none."""
        return np.array([np.nan if row[key] is None else row[key] for row in self.truth[table]], dtype=float)


@cache
def case(name: str) -> Case:
    """One reference case by its name."""
    truth = json.loads((FOLDER / f"{name}.json").read_text())
    return Case(Scene.model_validate(truth["preset"]), truth)
