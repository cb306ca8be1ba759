"""Pictures: sizes that geometry gives, colours that the scene gives, light where it can come from."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray

from hqmodel.gpu import MODES, render
from hqmodel.gpu.modes import MATERIALS
from hqmodel.gpu.packing import tint
from hqmodel.gpu.sight import light_uniforms
from hqmodel.model import VIEWS, Camera, Scene, Shape, Strip, Transform

from .scenes import ball, solid

Pixels = NDArray[np.uint8]
SIZE = (96, 80)
FRONT = replace(Camera(), azimuth=0.0, elevation=0.0, orthographic=True)


def _middle(pixels: Pixels) -> NDArray[np.float64]:
    height, width = pixels.shape[:2]
    return pixels[height // 2, width // 2, :3].astype(float)


def _block(*colors: tuple[float, float, float], gamma: float = 40.0) -> Scene:
    shape = solid(gamma).shapes[0]
    return Scene(shapes=tuple(shape.changed(color=color) for color in colors))


@pytest.mark.parametrize("radius", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("orthographic", [False, True])
def test_a_ball_covers_the_area_of_its_outline(ctx: moderngl.Context, radius: float, orthographic: bool) -> None:
    camera = replace(Camera(), distance=5 * radius, orthographic=orthographic)
    pixels = render(ball((0.0, 0.0, 0.0), radius), camera, (200, 160), "depth", ctx=ctx)
    covered = np.sum(pixels[..., 0] > 0)
    per_unit = 80 / camera.half_height()
    seen = radius if orthographic else camera.distance * np.tan(np.arcsin(0.2))
    assert covered == pytest.approx(np.pi * (seen * per_unit) ** 2, rel=0.02)


@pytest.mark.parametrize("mode", MODES)
def test_pictures_are_whole_and_the_same_each_time(ctx: moderngl.Context, mode: str) -> None:
    first, again = (render(solid(8.0), None, SIZE, mode, samples=4, ctx=ctx) for _ in range(2))
    assert first.shape == (80, 96, 4)
    assert first.dtype == np.uint8
    assert np.all(first[..., 3] == 255)
    assert np.array_equal(first, again)


def test_modes_differ(ctx: moderngl.Context) -> None:
    pictures = [render(solid(8.0), None, SIZE, mode, samples=2, ctx=ctx)[..., :3].astype(int) for mode in MODES]
    for one, other in combinations(pictures, 2):
        assert np.mean(np.abs(one - other)) > 4


def test_another_mode_is_refused(ctx: moderngl.Context) -> None:
    with pytest.raises(ValueError, match=rf"mode: expected one of {', '.join(MODES)}, got 'wax'"):
        render(ball(), None, SIZE, "wax", ctx=ctx)


@pytest.mark.parametrize("view", VIEWS)
def test_a_ball_faces_the_camera(ctx: moderngl.Context, view: str) -> None:
    camera = Camera().looking(view)
    pixels = render(ball(), camera, (97, 81), "normals", ctx=ctx)
    np.testing.assert_allclose(_middle(pixels), 127.5 * (1 + camera.axes()[2]), atol=2)


def test_top_is_up_and_right_is_right(ctx: moderngl.Context) -> None:
    scene = Scene(shapes=(ball((0.0, 0.0, 0.6), 0.2).shapes[0], ball((0.6, 0.0, -0.3), 0.2).shapes[0]))
    seen = render(scene, FRONT, SIZE, "depth", ctx=ctx)[..., 0] > 0
    row, column = FRONT.project([[0.0, 0.0, 0.6], [0.6, 0.0, -0.3]], SIZE).T[::-1].astype(int)
    assert seen[row, column].all()
    assert not seen[80 - row[0], column[0]]


def test_nearer_is_lighter(ctx: moderngl.Context) -> None:
    pixels = render(ball(), FRONT, SIZE, "depth", ctx=ctx)[40, :, 0].astype(int)
    seen = np.flatnonzero(pixels)
    assert np.all(np.diff(pixels[seen[1] : 48]) >= -1)
    assert pixels[48] > pixels[seen[1]] + 30


@pytest.mark.parametrize(("gamma", "sign", "lighter", "darker"), [(2.0, 1, 0, 2), (2.0, -1, 2, 0)])
def test_domes_are_warm_and_saddles_cool(ctx: moderngl.Context, gamma: float, sign: int, lighter: int, darker: int) -> None:
    strips = (Strip(normal=(1, 0, 0)), Strip(normal=(0, 1, 0)), Strip(normal=(0, 0, 1), gamma=gamma, sign=sign))
    scene = Scene(shapes=(Shape(strips=strips),), bounds=((-2, -2, -1), (2, 2, 1)))
    color = _middle(render(scene, FRONT, SIZE, "curvature", ctx=ctx))
    assert color[lighter] > color[darker] + 20


def test_flat_is_grey_in_curvature(ctx: moderngl.Context) -> None:
    color = _middle(render(solid(40.0), FRONT, SIZE, "curvature", ctx=ctx))
    assert np.ptp(color) < 12


@pytest.mark.parametrize(("view", "strip"), [("right", 0), ("front", 1), ("top", 2)])
def test_faces_have_their_strips_tint(ctx: moderngl.Context, view: str, strip: int) -> None:
    camera = replace(Camera(), orthographic=True).looking(view)
    color = _middle(render(solid(40.0), camera, SIZE, "strips", ctx=ctx))
    np.testing.assert_allclose(color, 255 * np.array(tint(strip)), atol=3)


def test_blended_colours_mix_by_their_shares(ctx: moderngl.Context) -> None:
    red, blue = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
    pure, both = (_middle(render(_block(*colors), FRONT, SIZE, samples=4, ctx=ctx)) for colors in ([red], [red, blue]))
    assert pure[0] > pure[2] + 60
    assert both[0] == pytest.approx(both[2], abs=25)


def test_the_body_stands_on_the_ground_and_shades_it(ctx: moderngl.Context) -> None:
    camera = Camera(distance=8.0, elevation=20.0)
    with_body = render(ball(), camera, SIZE, samples=16, ctx=ctx).astype(int)
    alone = render(Scene(shapes=()), camera, SIZE, samples=16, ctx=ctx).astype(int)
    column, row = camera.project([[0.0, 0.0, -1.0]], SIZE)[0].astype(int)
    under = slice(row + 2, row + 5)
    assert np.all(with_body[under, column, 1] < alone[under, column, 1] - 25)
    assert np.max(np.abs(with_body[-1] - alone[-1])) < 25


def test_no_ground_hides_the_body_from_below(ctx: moderngl.Context) -> None:
    pixels = render(_block((1.0, 0.1, 0.1)), replace(FRONT, elevation=-50.0), SIZE, samples=4, ctx=ctx)
    color = _middle(pixels)
    assert color[0] > 1.5 * color[1]


def test_the_floor_is_under_the_lowest_point(ctx: moderngl.Context) -> None:
    """A thin spike downwards: its tip touches its own shadow."""
    spike = Scene(shapes=(solid(1.0).shapes[0].changed(transform=Transform(scale=(0.3, 0.3, 1.0))),))
    camera = replace(FRONT, elevation=4.0, distance=4.0)
    seen = render(spike, camera, (160, 160), samples=16, ctx=ctx).astype(int)
    alone = render(Scene(shapes=()), camera, (160, 160), samples=16, ctx=ctx).astype(int)
    column, row = camera.project([[0.0, 0.0, -1.0]], (160, 160))[0].round().astype(int)
    assert np.min((seen - alone)[row - 1 : row + 3, column - 4 : column + 5, 1]) < -10


def test_a_hollow_is_darker_than_the_open(ctx: moderngl.Context) -> None:
    block, ball_there = solid(40.0).shapes[0], ball((0.0, -1.0, 0.0), 0.6).shapes[0]
    dent = Scene(shapes=(block, ball_there.changed(coefficient=-2.0, hardness=30.0)))
    whole, dented = (_middle(render(scene, FRONT, SIZE, samples=16, ctx=ctx)) for scene in (Scene(shapes=(block,)), dent))
    assert np.mean(dented) < np.mean(whole) - 10


def test_caps_face_along_the_box(ctx: moderngl.Context) -> None:
    strips = (Strip(normal=(1, 0, 0)), Strip(normal=(0, 1, 0)), Strip(normal=(0, 0, 1), sign=-1))
    scene = Scene(shapes=(Shape(strips=strips),), bounds=((-2, -2, -1), (2, 2, 1)))
    top = render(scene, replace(FRONT, elevation=90.0), SIZE, "normals", ctx=ctx)
    np.testing.assert_allclose(_middle(top), [127.5, 127.5, 255], atol=2)


def test_edges_are_smooth(ctx: moderngl.Context) -> None:
    pixels = render(_block((1.0, 1.0, 1.0)), replace(FRONT, azimuth=20.0, elevation=15.0), SIZE, "normals", ctx=ctx)
    assert len(np.unique(pixels.reshape(-1, 4), axis=0)) > 60


def test_large_pictures_are_drawn_in_parts(ctx: moderngl.Context) -> None:
    """1,200 pixels across take two parts: nothing shows where they meet."""
    pixels = render(ball(), Camera().framing([-1, -1, -1], [1, 1, 1], 100.0), (1200, 12), "normals", samples=1, ctx=ctx)
    whole = render(ball(), Camera().framing([-1, -1, -1], [1, 1, 1], 100.0), (1000, 10), "normals", samples=1, ctx=ctx)
    assert pixels.shape == (12, 1200, 4)
    np.testing.assert_allclose(pixels[6, ::6, :3].astype(int), whole[5, ::5, :3], atol=25)


def test_a_context_of_its_own() -> None:
    assert render(ball(), None, (8, 6), samples=1).shape == (6, 8, 4)


@pytest.mark.parametrize("mode", MATERIALS)
def test_materials_keep_the_shapes_colours(ctx: moderngl.Context, mode: str) -> None:
    red, green = (
        _middle(render(_block(color), None, SIZE, mode, samples=4, ctx=ctx)) for color in ((0.8, 0.1, 0.1), (0.1, 0.8, 0.1))
    )
    assert red[0] > 1.5 * red[1]
    assert green[1] > 1.5 * green[0]


def test_metal_mirrors_the_lamp_where_the_law_of_reflection_puts_it(ctx: moderngl.Context) -> None:
    """The brightest spot of a ball has its normal halfway between the eye and the lamp."""
    camera = replace(FRONT, distance=6.0)
    pixels = render(_colored_ball((0.5, 0.5, 0.5)), camera, (120, 120), "metal", ctx=ctx)[..., :3].sum(axis=2).astype(float)
    normals = render(ball(), camera, (120, 120), "normals", ctx=ctx)[..., :3] / 127.5 - 1
    brightest = np.mean(normals[pixels >= np.quantile(pixels[40:80, 40:80], 0.97)], axis=0)
    halfway = np.array(light_uniforms(camera)["key_direction"]) + camera.axes()[2]
    cosine = brightest @ halfway / np.linalg.norm(brightest) / np.linalg.norm(halfway)
    assert cosine > 0.97


def test_the_studio_throws_no_shadow_from_its_key_light(ctx: moderngl.Context) -> None:
    """To the left and right of a ball the bright ground is the same."""
    picture = render(ball(), replace(FRONT, elevation=25.0, distance=8.0), (120, 90), "studio", ctx=ctx)[..., :3].astype(float)
    left, right = picture[50:, :60].mean(), picture[50:, 60:].mean()
    assert left == pytest.approx(right, abs=3)
    assert picture[3, 3].min() > 215


def _colored_ball(color: tuple[float, float, float]) -> Scene:
    return Scene(shapes=(ball().shapes[0].changed(color=color),))
