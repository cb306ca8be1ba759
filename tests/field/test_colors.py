"""Colours: mixed by weight in linear light, and there and back again."""

from __future__ import annotations

import numpy as np

from hqmodel.field import Terms, linear_to_srgb, mixed_colors, srgb_to_linear
from hqmodel.model import Scene, Shape, Strip, Transform

BALL = tuple(Strip(normal=n) for n in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
RED, BLUE, GREEN = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 1.0, 0.0)


def ball(x: float, color: tuple[float, float, float], coefficient: float = 1.0) -> Shape:
    return Shape(strips=BALL, color=color, coefficient=coefficient, hardness=4.0, transform=Transform(translation=(x, 0.0, 0.0)))


def test_halfway_between_two_shapes_their_light_is_halved() -> None:
    scene = Scene(shapes=(ball(-1, RED), ball(1, BLUE)))
    got = mixed_colors(scene, Terms.of(scene), [(0.0, 0.3, 0.2), (-1.9, 0, 0), (1.9, 0, 0)])
    half = float(linear_to_srgb(np.array(0.5)))
    np.testing.assert_allclose(got, [(half, 0, half), RED, BLUE], atol=1e-6)


def test_what_carves_gives_no_colour() -> None:
    scene = Scene(shapes=(ball(0, RED), ball(0.8, GREEN, coefficient=-2.0)))
    np.testing.assert_allclose(mixed_colors(scene, Terms.of(scene), [(0.3, 0, 0), (0.8, 0, 0)]), [RED, RED])


def test_there_and_back() -> None:
    values = np.linspace(0, 1, 1001)
    np.testing.assert_allclose(linear_to_srgb(srgb_to_linear(values)), values, atol=1e-6)
    np.testing.assert_allclose(srgb_to_linear(np.array([0.0, 0.5, 1.0])), [0, 0.21404114, 1], atol=1e-6)
