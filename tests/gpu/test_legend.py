"""The curvature mode's scale: numbers that mean what the picture's colours say."""

from __future__ import annotations

from dataclasses import replace

import moderngl
import numpy as np
import pytest

from hqmodel.field import region
from hqmodel.gpu import Legend, render, with_legend
from hqmodel.model import Camera, Scene

from .scenes import ball

LEGEND = Legend(20.0)


def _color_at(place: float) -> list[float]:
    colors = np.array(LEGEND.colors, dtype=float)
    return [float(np.interp(place, np.linspace(0, 1, len(colors)), part)) for part in colors.T]


@pytest.mark.parametrize("radius", [1e-3, 0.7, 30.0])
@pytest.mark.parametrize("scale_of_region", [1.0, 3.0])
def test_a_ball_has_the_colour_of_its_curvature(ctx: moderngl.Context, radius: float, scale_of_region: float) -> None:
    far = scale_of_region * radius
    scene = ball(radius=radius).changed(bounds=((-far,) * 3, (far,) * 3))
    legend = Legend.of(region(scene))
    camera = replace(Camera(distance=4 * radius), orthographic=True)
    color = render(scene, camera, (33, 33), "curvature", samples=2, ctx=ctx)[16, 16, :3]
    np.testing.assert_allclose(color, _color_at(legend.place(1 / radius**2)), atol=5)


def test_places_rise_with_curvature_and_are_even_about_0() -> None:
    values = np.array([-90.0, -20.0, -1.0, -0.01, 0.0, 0.01, 1.0, 20.0, 90.0])
    places = np.array([LEGEND.place(value) for value in values])
    assert np.all(np.diff(places) > 0)
    np.testing.assert_allclose(places + places[::-1], 1.0)
    assert (LEGEND.place(-20.0), LEGEND.place(0.0), LEGEND.place(20.0)) == (0.0, 0.5, 1.0)


def test_ticks_stand_at_their_numbers() -> None:
    ticks = LEGEND.ticks()
    assert [text for _, text in ticks] == ["-20", "-2", "0", "+2", "+20"]
    assert [place for place, _ in ticks] == pytest.approx([LEGEND.place(float(text)) for _, text in ticks])


@pytest.mark.parametrize("size", [1e-9, 0.3, 1.0, 7e4])
def test_the_end_is_a_round_number_that_follows_the_size(size: float) -> None:
    limit = Legend.of(region(ball(radius=size))).limit
    assert f"{limit:.15e}"[0] in "125"
    assert 30 < limit * size**2 <= 101


def test_a_scene_without_a_body_has_one_too() -> None:
    assert Legend.of(region(Scene(shapes=()))).limit == 100.0


def test_the_scale_is_drawn_where_there_is_room() -> None:
    large, small = (np.zeros((height, width, 4), dtype=np.uint8) for width, height in ((480, 360), (90, 60)))
    drawn = with_legend(large, LEGEND)
    assert drawn.shape == large.shape
    assert not large.any()
    assert not drawn[:, :300].any()
    shown = {tuple(color) for color in drawn[..., :3].reshape(-1, 3)}
    assert {LEGEND.colors[0], LEGEND.colors[-1]} <= shown
    assert not with_legend(small, LEGEND).any()
