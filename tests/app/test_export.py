"""Exports in the background: what they write, how they stop, and what they say when they can't."""

from __future__ import annotations

import threading
from pathlib import Path

import numpy as np
import pytest
import trimesh

from hqmodel import files, memory, mesh
from hqmodel.app import working
from hqmodel.app.asks import ChooseFile, ExportAs, Exported, ExportSettings, Problem
from hqmodel.app.export import ExportJob
from hqmodel.app.intents import Answer, Ask, Do, Put
from hqmodel.app.session import Session
from hqmodel.edit import new_scene


@pytest.fixture
def session() -> Session:
    return Session(files.Settings())


def ended(session: Session) -> None:
    assert session.job is not None
    session.job.wait(60)
    session.poll()
    assert session.job is None


def test_an_export_writes_the_body_and_reports_it(session: Session, tmp_path: Path) -> None:
    path = tmp_path / "ball.stl"
    session.apply([Do("export"), Answer(ExportSettings(path, resolution=32, unit="mm", size=50.0))])
    ended(session)
    told = session.dialogs[-1]
    assert isinstance(told, Exported)
    assert told.path == path
    assert told.report["watertight"] is True
    written = trimesh.load_mesh(path)
    assert written.is_watertight
    assert max(written.extents) == pytest.approx(50.0)
    assert len(written.faces) == told.report["faces"]


def test_an_export_within_a_tolerance_takes_few_triangles(session: Session, tmp_path: Path) -> None:
    path = tmp_path / "ball.stl"
    working.export(session, ExportSettings(path, unit="mm", size=50.0, tolerance=0.5))
    ended(session)
    told = session.dialogs[-1]
    assert isinstance(told, Exported)
    assert told.report["within_tolerance"] is True
    written = trimesh.load_mesh(path)
    assert len(written.faces) < 1000
    away = abs(np.linalg.norm(np.concatenate([written.triangles_center, written.vertices]), axis=1) - 25.0)
    assert 0.2 < away.max() <= 0.5


def test_the_scene_can_change_meanwhile(session: Session, tmp_path: Path) -> None:
    working.export(session, ExportSettings(tmp_path / "ball.ply", resolution=32))
    session.apply([Put(("shapes", 0, "transform", "scale"), (3.0, 3.0, 3.0), "Scale")])
    ended(session)
    assert max(trimesh.load_mesh(tmp_path / "ball.ply").extents) == pytest.approx(2.0, abs=1e-3)


@pytest.mark.parametrize("suffix", mesh.FORMATS)
def test_every_format_can_be_written_with_and_without_extras(tmp_path: Path, suffix: str) -> None:
    for extras in (True, False):
        path = tmp_path / f"{extras}{suffix}"
        job = ExportJob(new_scene(), ExportSettings(path, resolution=12, colors=extras, normals=extras))
        job.wait(60)
        assert isinstance(job.outcome, Exported), job.outcome
        assert path.stat().st_size > 0


def test_a_stopped_export_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "ball.obj"
    path.write_text("old")
    reported, go_on = threading.Event(), threading.Event()

    def wake() -> None:
        reported.set()
        go_on.wait(60)

    job = ExportJob(new_scene(), ExportSettings(path, resolution=32), wake)
    assert reported.wait(60)
    job.cancel()
    go_on.set()
    job.wait(60)
    assert not job.running
    assert job.outcome is None
    assert path.read_text() == "old"
    assert [item.name for item in tmp_path.iterdir()] == ["ball.obj"]


def test_stopping_is_said(session: Session, tmp_path: Path) -> None:
    working.export(session, ExportSettings(tmp_path / "ball.obj", resolution=256))
    session.apply([Do("stop export")])
    ended(session)
    assert session.dialogs == []
    assert session.message == "Export cancelled; nothing was written"
    assert list(tmp_path.iterdir()) == []


def test_quitting_stops_it(session: Session, tmp_path: Path) -> None:
    working.export(session, ExportSettings(tmp_path / "ball.obj", resolution=256))
    session.apply([Do("quit")])
    assert session.finished
    assert session.job is not None
    assert not session.job.running
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (ExportSettings(Path("no such folder/ball.obj"), resolution=12), "No such file or directory"),
        (ExportSettings(Path("ball.obj"), resolution=2), "resolution"),
        (ExportSettings(Path("ball.obj"), resolution=2048), "of memory that are free"),
    ],
)
def test_what_goes_wrong_is_told(
    session: Session, tmp_path: Path, settings: ExportSettings, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(memory, "available", lambda: 5e8)
    moved = ExportSettings(tmp_path / settings.path, settings.resolution)
    working.export(session, moved)
    ended(session)
    problem = session.dialogs[-1]
    assert isinstance(problem, Problem)
    assert said in problem.lines[0]
    assert list(tmp_path.iterdir()) == []


def test_the_chosen_file_goes_into_the_export_dialog(session: Session, tmp_path: Path) -> None:
    session.apply([Do("export"), Ask(ChooseFile("export", tmp_path)), Answer(tmp_path / "egg.ply")])
    asked = session.dialogs[-1]
    assert isinstance(asked, ExportAs)
    assert asked.settings.path == tmp_path / "egg.ply"
