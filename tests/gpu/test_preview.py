"""The preview: it gets finished, then costs nothing; it starts again when something changes; it leaves OpenGL as it was."""

from __future__ import annotations

import gc
from dataclasses import replace

import moderngl
import numpy as np
import pytest

from hqmodel.field import Terms, first_hits, region
from hqmodel.gpu import MODES, Preview, render
from hqmodel.model import Camera, Scene, Shape, Strip

from ..cases import case
from .scenes import ball, solid

SIZE = (90, 70)
CAMERA = Camera()


def _finish(preview: Preview, mode: str = "clay", camera: Camera = CAMERA) -> int:
    """Draw until there is nothing left; how many calls that took."""
    for call in range(1, 2000):
        if not preview.draw(camera, SIZE, mode):
            return call
    raise AssertionError("never finished")


@pytest.mark.parametrize("mode", MODES)
def test_it_becomes_what_render_draws(ctx: moderngl.Context, preview: Preview, mode: str) -> None:
    scene = solid(8.0)
    preview.show(scene)
    _finish(preview, mode)
    expected = render(scene, CAMERA, SIZE, mode, samples=preview.samples(mode), ctx=ctx)
    assert np.max(np.abs(preview.pixels().astype(int) - expected)) <= 2


def test_once_finished_it_draws_no_more(preview: Preview) -> None:
    preview.show(ball())
    assert _finish(preview, "normals") > 1
    before = preview.pixels()
    preview.texture.write(np.zeros_like(before).tobytes())
    assert not preview.draw(CAMERA, SIZE, "normals")
    assert not preview.pixels().any()


def test_a_draft_is_there_at_once_and_stays_while_quick(preview: Preview) -> None:
    preview.show(_red())
    assert preview.draw(CAMERA, SIZE, quick=True)
    draft = preview.pixels()
    assert draft[35, 45, 0] > draft[35, 45, 1] + 60
    assert preview.draw(CAMERA, SIZE, quick=True)
    assert np.array_equal(preview.pixels(), draft)


def test_any_change_starts_again(preview: Preview) -> None:
    preview.show(ball())
    _finish(preview, "normals")
    assert preview.draw(replace(CAMERA, azimuth=10.0), SIZE, "normals", quick=True)
    _finish(preview, "normals")
    assert preview.draw(CAMERA, SIZE, "depth", quick=True)
    _finish(preview, "normals")
    before = preview.pixels()
    preview.show(solid(40.0))
    assert preview.draw(CAMERA, SIZE, "normals", quick=True)
    assert np.mean(np.abs(preview.pixels().astype(int) - before)) > 3


def test_the_texture_has_the_size_asked_for(preview: Preview) -> None:
    for size in ((64, 48), (1, 1), (130, 257)):
        preview.draw(CAMERA, size, quick=True)
        assert preview.texture.size == size
        assert preview.pixels().shape == (size[1], size[0], 4)


def test_what_was_bound_is_bound_afterwards(ctx: moderngl.Context, preview: Preview) -> None:
    mine = ctx.framebuffer([ctx.texture((20, 10), 4)])
    mine.use()
    preview.show(case("two_holes").scene)
    preview.draw(CAMERA, SIZE)
    preview.pick(CAMERA, SIZE, (45, 35))
    assert ctx.detect_framebuffer().glo == mine.glo
    assert ctx.viewport == (0, 0, 20, 10)
    ctx.detect_framebuffer(0).use()
    mine.release()


def test_another_mode_is_refused(preview: Preview) -> None:
    with pytest.raises(ValueError, match="got 'wax'"):
        preview.draw(CAMERA, SIZE, "wax")


@pytest.mark.parametrize("pixel", [(45, 35), (60, 30), (30, 44)])
def test_picking_finds_the_point_under_the_pixel(preview: Preview, pixel: tuple[int, int]) -> None:
    scene = case("two_holes").scene
    preview.show(scene)
    camera = Camera().framing([-1, -1, -1], [1, 1, 1], SIZE[0] / SIZE[1])
    seen = preview.pick(camera, SIZE, pixel)
    origin, direction = camera.rays(np.array(pixel) + 0.5, SIZE)
    distance = first_hits(Terms.of(scene), region(scene), origin, direction)[0]
    assert seen is not None
    assert seen.distance == pytest.approx(distance, abs=1e-5)
    np.testing.assert_allclose(seen.point, origin + distance * direction, atol=1e-5)


def test_picking_names_shape_and_strip(preview: Preview) -> None:
    left, right = solid(40.0, (-1.5, 0.0, 0.0)).shapes[0], solid(40.0, (1.5, 0.0, 0.0)).shapes[0]
    preview.show(Scene(shapes=(left.changed(visible=False), left, right)))
    front = Camera(azimuth=0.0, elevation=0.0, distance=12.0)
    for x, shape in ((-1.5, 1), (1.5, 2)):
        column, row = front.project([x, 0.0, 0.0], SIZE).astype(int)
        seen = preview.pick(front, SIZE, (column, row))
        assert seen is not None
        assert (seen.shape, seen.strip) == (shape, 1)
    assert preview.pick(front, SIZE, (2, 2)) is None


def test_picking_a_cap_names_no_strip(preview: Preview) -> None:
    preview.show(
        Scene(shapes=(Shape(strips=(Strip(normal=(1, 0, 0)), Strip(normal=(0, 1, 0)))),), bounds=((-2, -2, -1), (2, 2, 1)))
    )
    seen = preview.pick(Camera(elevation=90.0), SIZE, (45, 35))
    assert seen is not None
    assert seen.point[2] == pytest.approx(1.0, abs=1e-6)
    assert seen.shape is None and seen.strip is None


def _living() -> int:
    """Textures and framebuffers that have not been released."""
    kinds = (moderngl.Texture, moderngl.Framebuffer)
    return sum(isinstance(thing, kinds) and not isinstance(thing.mglo, moderngl.InvalidObject) for thing in gc.get_objects())


def test_objects_are_given_back(ctx: moderngl.Context) -> None:
    gc.collect()
    before = _living()
    made = Preview(ctx)
    for size in (SIZE, (30, 20)):
        made.show(solid(8.0))
        made.draw(CAMERA, size)
    assert _living() > before
    made.release()
    gc.collect()
    assert _living() == before


def _red() -> Scene:
    return Scene(shapes=(ball().shapes[0].changed(color=(1.0, 0.05, 0.05)),))


@pytest.mark.parametrize("size", [(673, 706), (401, 301)])
def test_the_middle_of_a_ball_is_lit_like_what_is_around_it(preview: Preview, size: tuple[int, int]) -> None:
    """Where the surface faces the eye squarely a cosine may round to more than 1."""
    scene = case("sphere").scene
    preview.show(scene)
    where = region(scene)
    preview.draw(Camera().framing(where.low, where.high, size[0] / size[1]), size, "clay", quick=True)
    x, y = size[0] // 2, size[1] // 2
    around = preview.pixels()[y - 8 : y + 8, x - 8 : x + 8, :3].reshape(-1, 3).astype(int)
    assert np.max(np.ptp(around, axis=0)) < 45
