"""The rows: the same field in the unit frame, far from the origin and at any size; what is compiled for a scene."""

from __future__ import annotations

import numpy as np
import pytest

from hqmodel.field import Terms, region, srgb_to_linear, value
from hqmodel.gpu.layout import TERM, WIDTH
from hqmodel.gpu.packing import LIMIT, NEGLIGIBLE, Frame, Packed, pack, tint
from hqmodel.model import Group, Scene, Shape, Strip, Transform

from ..cases import NAMES, case
from .scenes import ball, random_scene


def _packed(scene: Scene) -> tuple[Packed, Frame]:
    terms = Terms.of(scene)
    frame = Frame.of(region(scene, terms))
    return pack(scene, terms, frame), frame


@pytest.mark.parametrize(("place", "size"), [((0.0, 0.0, 0.0), 1.0), ((1e3, -2e3, 5e2), 1e-4), ((3e5, 0.0, -7e5), 1e4)])
def test_h_is_the_same_in_the_unit_frame(place: tuple[float, float, float], size: float) -> None:
    scene = ball(place, size)
    packed, frame = _packed(scene)
    terms = Terms.of(scene)
    points = np.array(place) + size * np.random.default_rng(3).uniform(-1, 1, size=(50, 3))
    h_world = points @ terms.normal.T + terms.offset
    local = frame.local(points).astype(np.float32)
    h = local @ packed.strips["normal"].T + packed.strips["offset"]
    assert np.max(np.abs(local)) <= 1.01
    np.testing.assert_allclose(h, h_world, atol=2e-6)


def test_rows_follow_each_other_in_whole_lines() -> None:
    packed, _ = _packed(random_scene(np.random.default_rng(1), 6))
    texels = packed.texels()
    assert texels.shape[1:] == (WIDTH, 4)
    at = int(packed.uniforms["strip_rows"])
    assert at == TERM.texels * len(packed.terms)
    np.testing.assert_array_equal(texels.reshape(-1, 4)[at, :3], packed.strips["normal"][0])


def test_groups_lead_with_their_count_of_members() -> None:
    strips = [Strip(normal=n, group=g) for n, g in (((1, 0, 0), "a"), ((0, 1, 0), None), ((0, 0, 1), "a"))]
    packed, _ = _packed(Scene(shapes=(Shape(strips=tuple(strips), groups={"a": Group(gamma=9.0)}),)))
    assert packed.strips["members"].tolist() == [1, 2, 0]
    assert packed.strips["outer"].tolist() == [2, 9, 9]
    assert packed.terms["count"].tolist() == [3]


@pytest.mark.parametrize("name", NAMES)
def test_defines_say_what_a_scene_has(name: str) -> None:
    scene = case(name).scene
    packed, _ = _packed(scene)
    shapes, strips = scene.shapes, [strip for shape in scene.shapes for strip in shape.strips]
    assert ("GROUPS" in packed.defines) == any(strip.group for strip in strips)
    assert ("HYPERBOLIC" in packed.defines) == any(strip.sign < 0 for strip in strips)
    assert ("CARVING" in packed.defines) == any(shape.coefficient < 0 for shape in shapes)
    lone = len(shapes) == 1 and not shapes[0].mirror
    assert ("LONE" in packed.defines) == lone
    assert ("CONVEX" in packed.defines) == (lone and all(strip.gamma >= 1 for strip in strips))


def test_mirror_images_share_their_strips_tints() -> None:
    scene = ball((2.0, 0.0, 0.0), 1.0)
    scene = scene.changed(shapes=(scene.shapes[0].changed(mirror=("x",)),))
    packed, _ = _packed(scene)
    assert len(packed.terms) == 2
    np.testing.assert_array_equal(packed.strips["tint"][:3], packed.strips["tint"][3:])


@pytest.mark.parametrize("seed", range(12))
def test_terms_matter_only_within_their_reach_and_box(seed: int) -> None:
    rng = np.random.default_rng(seed)
    scene = random_scene(rng, 5)
    packed, frame = _packed(scene)
    terms, where = Terms.of(scene), region(scene)
    points = rng.uniform(where.low - 0.2 * where.size, where.high + 0.2 * where.size, size=(4000, 3))
    local = frame.local(points)
    starts = np.flatnonzero(np.diff(terms.term_of_strip, prepend=-1))
    within = np.abs(local @ packed.strips["normal"].T + packed.strips["offset"]) <= packed.strips["reach"] * (1 + 1e-6)
    in_reach = np.logical_and.reduceat(within, starts, axis=1)
    in_box = np.all((local[:, None] >= packed.terms["low"]) & (local[:, None] <= packed.terms["high"]), axis=2)
    share = np.array([value(terms.keep(np.arange(len(terms)) == k), points) for k in range(len(terms))]).T + terms.level
    outside = np.where(in_reach & in_box, 0.0, np.abs(share))
    assert np.max(np.sum(outside, axis=1)) <= NEGLIGIBLE * terms.level
    assert not np.any(in_reach & ~in_box)


def test_huge_numbers_are_packed_finite_and_keep_their_plane() -> None:
    strips = (Strip(normal=(1e200, 0, 0), offset=5e199), Strip(normal=(0, 1, 0)), Strip(normal=(0, 0, 1)))
    scene = Scene(shapes=(Shape(strips=strips, transform=Transform(scale=(1e-5, 1.0, 1.0)), hardness=1e300),))
    packed, _ = _packed(scene)
    for rows in (packed.terms, packed.strips):
        assert np.all(np.isfinite(rows.view(np.float32)))
    assert np.max(np.abs(packed.strips["normal"])) <= LIMIT * 1.001


def test_an_empty_scene_packs() -> None:
    packed, frame = _packed(Scene(shapes=()))
    assert len(packed.terms) == len(packed.strips) == 0
    assert packed.texels().shape == (1, WIDTH, 4)
    assert frame.scale == 1.0


def test_colours_are_linear_and_tints_differ() -> None:
    np.testing.assert_allclose(srgb_to_linear(np.array([0.0, 0.5, 1.0])), [0.0, 0.214041, 1.0], atol=1e-6)
    tints = np.array([tint(number) for number in range(8)])
    apart = np.linalg.norm(tints[:, None] - tints[None], axis=2) + np.eye(8)
    assert np.min(apart) > 0.1
