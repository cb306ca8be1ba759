"""Playing shows what the animation says and changes nothing; the slice's range is where there is a body."""

from __future__ import annotations

from pathlib import Path

import pytest

from hqmodel import files
from hqmodel.app.asks import Open
from hqmodel.app.intents import Do, Play, Stop
from hqmodel.app.player import Player
from hqmodel.app.session import Session
from hqmodel.app.slices import SliceRange, share_at, sliding
from hqmodel.edit import new_scene
from hqmodel.edit.animation import Animation, Repeat, Sweep
from hqmodel.model import FIELDS, Camera, Scene, Shape, Strip

LEVEL = Animation(duration=2.0, easing="linear", sweeps=(Sweep(path="level", values=(0.5, 1.5), scale="linear"),))


@pytest.fixture
def session() -> Session:
    return Session(files.Settings())


def test_time_leads_through_the_round_and_begins_again() -> None:
    player, scene = Player(), new_scene()
    player.play(LEVEL)
    shown = []
    for now in (10.0, 10.5, 11.0, 12.5):
        player.advance(now)
        shown.append(player.scene(scene).level)
    assert shown == [0.5, 0.75, 1.0, 0.75]
    assert player.scene(scene) is player.scene(scene), "nothing to be drawn anew"
    player.stop()
    assert player.scene(scene) is scene


def test_once_rests_at_the_end() -> None:
    player = Player()
    player.play(LEVEL.changed(repeat="once"))
    for now in (0.0, 1.0, 5.0, 6.0):
        player.advance(now)
    assert not player.running
    assert player.scene(new_scene()).level == 1.5


def test_there_and_back() -> None:
    player = Player()
    player.play(LEVEL.changed(repeat="ping-pong"))
    levels = []
    for now in (0.0, 0.5, 1.0, 1.5):
        player.advance(now)
        levels.append(player.scene(new_scene()).level)
    assert levels == [0.5, 1.0, 1.5, 1.0]


def test_the_camera_is_led_too() -> None:
    turn = Animation(easing="linear", sweeps=(Sweep(path="view.camera.azimuth", values=(0.0, 360.0), scale="linear"),))
    player = Player()
    player.play(turn, 0.25, running=False)
    assert player.camera(Camera()).azimuth == 90.0
    player.stop()
    assert player.camera(Camera()) == Camera()


def test_playing_is_no_step_and_editing_goes_on(session: Session) -> None:
    before = session.scene
    session.apply([Play(LEVEL, 0.5, running=False)])
    assert (session.shown.level, session.scene) == (1.0, before)
    assert not session.history.dirty
    session.apply([Do("add block")])
    assert (len(session.shown.shapes), session.shown.level) == (2, 1.0)
    assert session.history.labels == ["Add block"]
    session.apply([Stop()])
    assert session.shown is session.scene


def test_what_can_no_longer_be_played_is_said_and_ends(session: Session) -> None:
    session.apply([Do("add block")])
    path = "shapes[1].strips[0].gamma"
    session.apply([Play(Animation(sweeps=(Sweep(path=path, values=(2.0, 4.0), scale="log"),)))])
    session.apply([Do("undo")])
    assert session.shown is session.scene
    assert session.failed
    assert session.player.animation is None


def test_another_document_ends_it(session: Session, tmp_path: Path) -> None:
    files.save(new_scene(), tmp_path / "a.json")
    session.apply([Play(LEVEL), Open(tmp_path / "a.json")])
    assert session.shown is session.scene


@pytest.mark.parametrize("repeat", ["loop", "ping-pong"])
@pytest.mark.parametrize("t", [-1.5, 0.0, 1.0])
def test_the_slice_plays_on_from_where_it_is(repeat: Repeat, t: float) -> None:
    player, span = Player(), (-2.0, 3.0)
    player.play(sliding(span, 4.0, repeat), share_at(t, span, repeat), running=True)
    player.advance(0.0)
    assert player.scene(new_scene()).slice == pytest.approx(t)
    player.advance(0.4)
    assert player.scene(new_scene()).slice == pytest.approx(t + 0.5), "a tenth of the range"


def test_the_range_of_the_slice_is_found_while_one_goes_on() -> None:
    """A slab |z| <= 1 that slides twice as fast as t, between fixed ones: no end; held by a fourth strip, an end."""
    still = [Strip(normal=n) for n in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    held = Scene(shapes=(Shape(strips=(*still, Strip(normal=(0, 0, 1), slice=2.0))),))
    woken: list[None] = []
    spans = SliceRange()
    assert spans.of(held, lambda: woken.append(None)) == FIELDS["slice"].slider
    spans._worker.shutdown()
    assert woken == [None]
    low, high = spans.of(held, lambda: None)
    assert -1.0 <= low < 0 < high <= 1.0, "|z| <= 1 and |z + 2 t| <= 1"
    assert low == -high
