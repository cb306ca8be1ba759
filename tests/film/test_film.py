"""Films: frames that are what a still picture shows, made in a thread of their own; stopped anywhere, they leave nothing."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from hqmodel import film
from hqmodel.edit import Animation, Sweep, new_scene
from hqmodel.field import Plane, region
from hqmodel.gpu import render
from hqmodel.model import Camera

BULGING = Animation(repeat="once", easing="linear", sweeps=(Sweep(path="gamma", values=(2.0, 8.0)),))
NEAR = Camera(azimuth=10.0, elevation=20.0, distance=5.0)
PLAN = film.Plan(new_scene(), NEAR, BULGING, False, 3, 0.3, (24, 18), whole=False)


def picture(path: Path) -> NDArray[np.uint8]:
    with Image.open(path) as image:
        return np.asarray(image)


def test_frames_are_still_pictures_from_where_the_camera_is(tmp_path: Path) -> None:
    plan = replace(PLAN, turning=True, cut=Plane((0.0, 0.0, 1.0), 0.2))
    files = film.shoot(plan, tmp_path / "a.png")
    assert [path.name for path in files] == ["a_0001.png", "a_0002.png", "a_0003.png"]
    for index, (path, gamma) in enumerate(zip(files, (2.0, 5.0, 8.0), strict=True)):
        shape = plan.scene.shapes[0]
        scene = plan.scene.changed(shapes=(shape.changed(strips=tuple(strip.changed(gamma=gamma) for strip in shape.strips)),))
        camera = replace(NEAR, azimuth=NEAR.azimuth + 120 * index)
        still = render(scene, camera, plan.size, cut=plan.cut, samples=4)
        assert np.array_equal(picture(path), still[..., :3])


def test_whole_is_from_so_far_that_all_is_seen(tmp_path: Path) -> None:
    close = replace(PLAN, camera=replace(NEAR, distance=1.5), whole=True)
    (first, *_) = film.shoot(close, tmp_path / "a.png")
    where = region(close.scene)
    framed = close.camera.framing(where.low, where.high, 24 / 18)
    assert np.array_equal(picture(first), render(close.scene, framed, close.size, samples=4)[..., :3])


def test_a_film_can_be_made_in_a_thread(tmp_path: Path) -> None:
    thread = threading.Thread(target=film.shoot, args=(PLAN, tmp_path / "there.gif"))
    thread.start()
    thread.join(60)
    film.shoot(PLAN, tmp_path / "here.gif")
    assert (tmp_path / "there.gif").read_bytes() == (tmp_path / "here.gif").read_bytes()


class Stopped(Exception):
    pass


def stopping(after: int) -> Callable[[float, str], None]:
    """Listens to so many reports, and raises at the next."""
    left = iter(range(after))

    def report(*_: object) -> None:
        if next(left, None) is None:
            raise Stopped

    return report


@pytest.mark.parametrize("name", ["a.gif", "a.png"])
def test_stopped_at_any_report_it_leaves_what_was_there(tmp_path: Path, name: str) -> None:
    for old in ("a.gif", "a_0002.png"):
        (tmp_path / old).write_text("old")
    reports: list[float] = []
    film.shoot(PLAN, tmp_path / f"other{name}", lambda share, _: reports.append(share))
    assert reports == sorted(reports)
    assert (reports[0], reports[-1]) == (0.0, 1.0)
    made = {path.name for path in tmp_path.iterdir()}
    for stop in (0, len(reports) // 2, len(reports) - 2, len(reports) - 1):
        with pytest.raises(Stopped):
            film.shoot(PLAN, tmp_path / name, stopping(stop))
        assert {path.name for path in tmp_path.iterdir()} == made
        assert (tmp_path / "a.gif").read_text() == (tmp_path / "a_0002.png").read_text() == "old"


def test_what_cannot_be_is_told_before_anything_is_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    for name, fault in (("a.webp", "expected a file name that ends in .gif"), ("a.gif", "expected at most 50 frames a second")):
        with pytest.raises(film.FilmError, match=f"^{name}: {fault}"):
            film.check(Path(name), 60, 1.0)
    with pytest.raises(film.NoWriter, match=r"^a\.mp4: expected ffmpeg"):
        film.check(Path("a.mp4"), 60, 1.0)
