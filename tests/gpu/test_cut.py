"""The section view, what is lit and the shells: exact where they cut, and cheap where they only tint."""

from __future__ import annotations

from dataclasses import replace

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray

from hqmodel.field import Plane, Terms, first_hits
from hqmodel.gpu import MODES, Preview, render
from hqmodel.model import Camera, Scene

from ..cases import case
from .scenes import ball, solid

SIZE = (96, 80)
CAMERA = Camera()


def _finished(preview: Preview, lit_strip: tuple[int, int] | None = None, ghosts: bool = False) -> NDArray[np.int64]:
    while preview.draw(CAMERA, SIZE, "normals", lit_strip=lit_strip, ghosts=ghosts):
        pass
    return preview.pixels().astype(np.int64)


def _cut_hits(preview: Preview, cut: Plane, pixels: NDArray[np.int64]) -> NDArray[np.float64]:
    """Distances from the eye by the reference: rays begin at the plane, or end there."""
    origins, directions = CAMERA.rays(pixels + 0.5, SIZE)
    height = origins @ cut.axes[2] - cut.axes[2] @ cut.origin
    way = -height / (directions @ cut.axes[2])
    enters = height > 0
    begin = np.where(enters & (way > 0), way, 0.0)
    distance = begin + first_hits(Terms.of(preview.scene), preview.region, origins + begin[:, None] * directions, directions)
    distance[enters & (way < 0) | ~enters & (way > 0) & (distance > way)] = np.nan
    return distance


@pytest.mark.parametrize("name", ["two_holes", "truncated_tetrahedron", "composite_1"])
@pytest.mark.parametrize("cut", [Plane((0, -1, 0), 0.1), Plane((0.3, -1, 0.5), -0.2), Plane((0, 0, -2), 0.4)], ids=str)
def test_rays_end_in_the_cut_or_behind_it(preview: Preview, name: str, cut: Plane) -> None:
    preview.show(case(name).scene)
    pixels = np.random.default_rng(5).integers(0, SIZE, size=(60, 2))
    for pixel, expected in zip(pixels, _cut_hits(preview, cut, pixels), strict=True):
        seen = preview.pick(CAMERA, SIZE, (int(pixel[0]), int(pixel[1])), cut)
        assert (seen.distance if seen else np.nan) == pytest.approx(expected, abs=2e-5, nan_ok=True)
        if seen is not None:
            height = np.array(seen.point) @ cut.axes[2] - cut.axes[2] @ cut.origin
            assert height < 1e-5
            assert (seen.strip is None) == (height > -1e-5)


@pytest.mark.parametrize("mode", MODES)
def test_the_cut_is_filled_in_every_mode(ctx: moderngl.Context, mode: str) -> None:
    camera = replace(CAMERA, elevation=90.0, orthographic=True)
    cut = render(ball(), camera, SIZE, mode, Plane((0, 0, 1), 0.0), 4, ctx)
    beside = cut[40, 3, :3].astype(float)
    filled = cut[30:50, 38:58, :3].reshape(-1, 3).astype(float)
    assert np.min(np.max(np.abs(filled - beside), axis=1)) > 15


def test_light_falls_into_what_is_cut_open(ctx: moderngl.Context) -> None:
    """The floor of a hollow, seen from above through the opening: no lid that is not there throws its shadow on it."""
    hollow = Scene(shapes=(solid(20.0).shapes[0], solid(20.0, size=0.8).shapes[0].changed(coefficient=-4.0, hardness=20.0)))
    camera = replace(CAMERA, elevation=75.0)
    picture = render(hollow, camera, SIZE, cut=Plane((0, 0, 1), -0.3), samples=8, ctx=ctx).astype(float)
    column, row = camera.project([[0.0, 0.0, -0.8]], SIZE)[0].astype(int)
    assert picture[row - 2 : row + 3, column - 2 : column + 3, :3].mean() > 110


def test_nothing_is_left_in_front_of_the_body(preview: Preview) -> None:
    preview.show(ball())
    assert preview.pick(CAMERA, SIZE, (48, 40), Plane((0, 0, 1), -2.0)) is None
    seen = preview.pick(CAMERA, SIZE, (48, 40), Plane((0, 0, 1), 2.0))
    assert seen is not None
    assert seen.strip is not None


def test_another_cut_starts_again(preview: Preview) -> None:
    preview.show(ball())
    _finished(preview)
    assert preview.draw(CAMERA, SIZE, "normals", cut=Plane((0, 0, 1), 0.2), quick=True)


def test_lighting_a_strip_starts_nothing_again(preview: Preview) -> None:
    preview.show(solid(40.0))
    before = _finished(preview)
    assert not preview.draw(CAMERA, SIZE, "normals", lit_strip=(0, 2))
    lit = preview.pixels().astype(np.int64)
    column, row = CAMERA.project([[0.0, 0.0, 1.0]], SIZE)[0].astype(int)
    assert np.max(np.abs(lit - before)[row, column]) > 30
    column, row = CAMERA.project([[0.0, -1.0, 0.0]], SIZE)[0].astype(int)
    assert np.array_equal(lit[row, column], before[row, column])
    assert not preview.draw(CAMERA, SIZE, "normals")
    assert np.array_equal(preview.pixels(), before)


def test_what_is_lit_stays_lit_while_the_picture_grows(preview: Preview) -> None:
    preview.show(solid(40.0))
    later = _finished(preview, (0, 1))
    preview.show(solid(40.0))
    _finished(preview)
    preview.draw(CAMERA, SIZE, "normals", lit_strip=(0, 1))
    assert np.array_equal(preview.pixels(), later)


def test_mirror_images_are_lit_together(preview: Preview) -> None:
    shape = solid(40.0, (1.2, 0.0, 0.0), 0.6).shapes[0]
    preview.show(Scene(shapes=(ball(radius=0.3).shapes[0], shape.changed(mirror=("x",)))))
    changed = np.any(_finished(preview) != _finished(preview, (1, 2)), axis=2)
    columns, rows = CAMERA.project([[1.2, 0.0, 0.6], [-1.2, 0.0, 0.6], [0.0, 0.0, 0.3]], SIZE).astype(int).T
    assert changed[rows, columns].tolist() == [True, True, False]


def test_a_strip_of_a_hidden_shape_lights_nothing(preview: Preview) -> None:
    preview.show(ball())
    assert np.array_equal(_finished(preview), _finished(preview, (3, 0)))


def test_shapes_that_carve_are_shown_as_shells(preview: Preview) -> None:
    """The shell of a ball that carves a dent is seen through its opening, and where it stands out of the body."""
    dent = ball((0.0, -1.0, 0.3), 0.5).shapes[0].changed(coefficient=-2.0, hardness=30.0)
    preview.show(Scene(shapes=(solid(40.0).shapes[0], dent)))
    changed = np.any(_finished(preview) != _finished(preview, ghosts=True), axis=2)
    columns, rows = CAMERA.project([[0.0, -1.4, 0.3], [1.0, 0.0, -0.5], [1.6, 0.0, 0.0]], SIZE).astype(int).T
    assert changed[rows, columns].tolist() == [True, False, False]


def test_without_any_there_are_no_shells(preview: Preview) -> None:
    preview.show(solid(8.0))
    assert np.array_equal(_finished(preview), _finished(preview, ghosts=True))
