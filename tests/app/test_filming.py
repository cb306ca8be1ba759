"""Films from the window: what the dialog begins with, what the job writes, and how it stops."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from PIL import Image

from hqmodel import files, gpu
from hqmodel.app import working
from hqmodel.app.asks import ChooseFile, FilmAs, Filmed, FilmSettings, Problem
from hqmodel.app.intents import Animate, Answer, Ask, Do, Edit, Pick, Resize
from hqmodel.app.session import Session
from hqmodel.edit.sweeping import turntable

SMALL = (24, 18)


@pytest.fixture
def session() -> Session:
    return Session(files.Settings())


def ended(session: Session) -> None:
    assert session.job is not None
    session.job.wait(60)
    session.poll()
    assert session.job is None


def asked(session: Session) -> FilmAs:
    session.apply([Do("film")])
    dialog = session.dialogs[-1]
    assert isinstance(dialog, FilmAs)
    return dialog


def test_without_an_animation_the_view_turns(session: Session, tmp_path: Path) -> None:
    session.apply([Resize((800, 700))])
    settings = asked(session).settings
    assert settings.size == (640, 560), "the sides are as they are in the viewport"
    assert (settings.animation, settings.turning) == (None, True)
    path = tmp_path / "turn.gif"
    session.apply([Answer(replace(settings, path=path, seconds=0.4, fps=10.0, size=SMALL))])
    ended(session)
    told = session.dialogs[-1]
    assert told == Filmed((path,), "4 frames, 0.4 s, 24 x 18 pixels")
    with Image.open(path) as film:
        assert (film.n_frames, film.size) == (4, SMALL)  # type: ignore[attr-defined]


def test_what_is_picked_is_filmed_as_it_is_seen(session: Session, tmp_path: Path) -> None:
    session.apply([Animate(("shapes", 0, "strips", 0, "gamma"), "Exponent")])
    session.apply([Edit("Turntable", lambda scene: turntable(scene, session.view.camera)), Pick(0), Do("mode normals")])
    dialog = asked(session)
    assert [dialog.animations[index][1] for index in range(2)] == [4.0, dialog.animations[1][1]]
    assert (dialog.settings.animation, dialog.settings.turning, dialog.settings.seconds) == (0, False, 4.0)
    settings = replace(dialog.settings, path=tmp_path / "a#.png", seconds=0.2, fps=10.0, size=SMALL)
    session.apply([Answer(settings)])
    ended(session)
    still = gpu.render(session.scene, session.view.camera, SMALL, "normals", samples=4)
    with Image.open(tmp_path / "a1.png") as first:
        assert first.tobytes() == still[..., :3].tobytes()
    assert not session.history.dragging
    assert session.exported is None


def test_an_animation_that_is_at_fault_is_not_offered(session: Session) -> None:
    session.apply([Edit("Spoil", lambda scene: scene.changed(animations=({"sweeps": []},)))])
    assert not asked(session).animations


def test_stopped_it_leaves_nothing(session: Session, tmp_path: Path) -> None:
    settings = FilmSettings(tmp_path / "long.gif", None, True, seconds=600.0, size=SMALL)
    working.shoot(session, settings)
    assert session.job is not None
    session.apply([Do("stop export")])
    ended(session)
    assert session.message == "Film cancelled; nothing was written"
    assert not list(tmp_path.iterdir())


def test_a_film_that_cannot_be_written_is_told(session: Session, tmp_path: Path) -> None:
    path = tmp_path / "gone" / "a.gif"
    working.shoot(session, FilmSettings(path, None, True, seconds=0.2, fps=10.0, size=SMALL))
    ended(session)
    assert session.dialogs[-1] == Problem("Film failed", (f"{path}: No such file or directory",))


def test_the_chosen_file_goes_into_the_dialog(session: Session, tmp_path: Path) -> None:
    asked(session)
    session.apply([Ask(ChooseFile("export", tmp_path, "a.png", (".png",))), Answer(tmp_path / "a.png")])
    dialog = session.dialogs[-1]
    assert isinstance(dialog, FilmAs)
    assert dialog.settings.path == tmp_path / "a.png"
