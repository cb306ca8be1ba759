"""Points and meshes brought in: fitted in the background, in one step, the points kept to be looked at."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from hqmodel import files
from hqmodel.app import editing, filing, working
from hqmodel.app.asks import ImportAs, ImportSettings, Problem
from hqmodel.app.importing import SHOWN
from hqmodel.app.intents import Answer, Do, Put
from hqmodel.app.session import Session
from hqmodel.field import Terms, region, value
from hqmodel.model import Scene


@pytest.fixture
def session() -> Session:
    return Session(files.Settings())


def ball(path: Path, count: int = 600) -> Path:
    """Points of a ball of radius 2 about (5, 0, 0)."""
    directions = np.random.default_rng(1).normal(size=(count, 3))
    points = 2 * directions / np.linalg.norm(directions, axis=1, keepdims=True) + (5, 0, 0)
    np.savetxt(path, points)
    return path


def ended(session: Session) -> None:
    assert session.job is not None
    session.job.wait(120)
    session.poll()
    assert session.job is None


def test_a_dropped_cloud_is_fitted_in_place_of_a_scene_nobody_touched(session: Session, tmp_path: Path) -> None:
    filing.take(session, ball(tmp_path / "ball.xyz", 5000))
    asked = session.dialogs[-1]
    assert isinstance(asked, ImportAs)
    before = session.scene
    session.apply([Answer(asked.settings)])
    ended(session)
    assert session.history.labels == ["Fit"]
    assert session.scene.name == "ball"
    box = region(session.scene)
    assert np.allclose((box.low, box.high), [(3, -2, -2), (7, 2, 2)], atol=0.1)
    assert session.cloud is not None
    assert len(session.cloud.points) <= SHOWN + 1
    assert np.median(np.abs(session.cloud.distances)) < 1e-3
    assert session.selection.shapes == (0,)
    editing.undo(session)
    assert session.scene is before


def test_beside_what_there_is(session: Session, tmp_path: Path) -> None:
    session.apply([Put(("shapes", 0, "hardness"), 8.0, "Hardness")])
    first = session.scene.shapes[0]
    working.fit(session, ImportSettings(ball(tmp_path / "ball.xyz")))
    ended(session)
    assert session.scene.shapes[0] == first
    assert len(session.scene.shapes) == 2
    alone = Scene(shapes=session.scene.shapes[1:])
    assert value(Terms.of(alone), (5, 0, 0)) > 0
    assert value(Terms.of(alone), (0, 0, 0)) < 0


def test_what_is_wrong_with_a_file_is_told_and_nothing_changes(session: Session, tmp_path: Path) -> None:
    before = session.scene
    (tmp_path / "bad.xyz").write_text("1 2\n")
    for path in (tmp_path / "bad.xyz", tmp_path / "nowhere.ply"):
        working.fit(session, ImportSettings(path))
        ended(session)
        told = session.dialogs.pop()
        assert isinstance(told, Problem)
        assert told.title == "Fit failed"
        assert len(told.lines) == 1
    assert session.scene is before


def test_it_can_be_stopped(session: Session, tmp_path: Path) -> None:
    before = session.scene
    working.fit(session, ImportSettings(ball(tmp_path / "ball.xyz"), parts=8))
    session.apply([Do("stop export")])
    ended(session)
    assert session.message == "Fit cancelled; nothing was changed"
    assert session.scene is before
