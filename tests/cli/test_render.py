"""render: pictures of the size, view and mode asked for."""

from __future__ import annotations

import json

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from hqmodel.gpu import MODES

from .conftest import Command, files


def picture(name: str) -> NDArray[np.int64]:
    with Image.open(name) as image:
        return np.asarray(image.convert("RGB"), dtype=np.int64)


def test_the_picture_has_the_size_asked_for_and_the_body_in_its_middle(hqmodel: Command) -> None:
    ended = hqmodel("render", "ball.json", "-o", "a.png", "--size", "120x80", "--json")
    assert (ended.status, ended.err) == (0, "")
    result = json.loads(ended.out)
    assert (result["width"], result["height"], result["mode"], result["files"]) == (120, 80, "clay", ["a.png"])
    pixels = picture("a.png")
    assert pixels.shape == (80, 120, 3)
    assert np.abs(pixels[40, 60] - pixels[4, 4]).max() > 20


def test_views_and_angles_agree(hqmodel: Command) -> None:
    tilted = ["--set", "shapes[0].transform.scale=[1, 2, 0.5]", "--size", "64x64"]
    views = {"right.png": ["--view", "right"], "same.png": ["--azimuth", "90", "--elevation", "0"], "top.png": ["--view", "top"]}
    for name, options in views.items():
        assert hqmodel("render", "ball.json", "-o", name, *tilted, *options).status == 0
    assert np.array_equal(picture("right.png"), picture("same.png"))
    assert not np.array_equal(picture("right.png"), picture("top.png"))


def test_each_mode_is_another_picture(hqmodel: Command) -> None:
    modes = ["clay", "normals", "curvature", "strips", "depth"]
    for mode in modes:
        assert hqmodel("render", "ball.json", "-o", f"{mode}.png", "--mode", mode, "--size", "48x48").status == 0
    pictures = {picture(f"{mode}.png").tobytes() for mode in modes}
    assert len(pictures) == len(modes)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["-o", "a.jpg"], "a.jpg: expected a file name that ends in .png, got .jpg"),
        (["-o", "a.png", "--size", "640"], "--size: expected WxH in pixels, each from 1 to 8192, got '640'"),
        (["-o", "a.png", "--size", "0x10"], "--size: expected WxH in pixels, each from 1 to 8192, got '0x10'"),
        (["-o", "a.png", "--size", "10x9999"], "--size: expected WxH in pixels, each from 1 to 8192, got '10x9999'"),
        (["-o", "a.png", "--view", "up"], "--view: expected front, right, back, left, top, bottom, iso, got 'up'"),
        (["-o", "a.png", "--mode", "wax"], f"--mode: expected {', '.join(MODES)}, landscape, got 'wax'"),
        (["-o", "a.png", "--mode", "landscape"], "--mode: expected another one than landscape for a solid preset"),
        (["-o", "a.png", "--mode", "landscape", "--cut", "x=0"], "--cut: expected another --mode with it than landscape"),
        (["-o", "a.png", "--elevation", "91"], "--elevation: expected degrees from -90 to 90, got 91.0"),
        (["-o", "a.png", "--azimuth", "nan"], "--azimuth: expected degrees from -360 to 360, got nan"),
    ],
)
def test_wrong_options_are_told(hqmodel: Command, arguments: list[str], message: str) -> None:
    assert hqmodel("render", "ball.json", *arguments) == (2, "", message + "\n")
    assert files() == {"ball.json"}


def test_a_cut_opens_the_body(hqmodel: Command) -> None:
    """From above, a ball cut at its middle is a disk that faces up, one cut off whole is gone."""
    for name, plane in (("half", "z=0"), ("none", "0,0,2=-3")):
        arguments = ["--view", "top", "--mode", "normals", "--size", "40x40", "--cut", plane]
        assert hqmodel("render", "ball.json", "-o", f"{name}.png", *arguments).status == 0
    half, none = picture("half.png"), picture("none.png")
    assert np.ptp(half[16:24, 16:24].reshape(-1, 3), axis=0).max() <= 2
    assert half[20, 20, 2] > half[20, 20, 0] + 80
    assert np.ptp(none.reshape(-1, 3), axis=0).max() <= 2


def test_a_cut_that_is_none_is_told(hqmodel: Command) -> None:
    expected = "--cut: expected a plane such as z=0.2 or 1,0,-1=0.5, got 'w=1'\n"
    assert hqmodel("render", "ball.json", "-o", "a.png", "--cut", "w=1") == (2, "", expected)


def test_a_landscape_shows_the_hills_that_rise_over_the_level(hqmodel: Command) -> None:
    """The higher the level, the more of its bluish plane is seen; above all hills, all of it is, and all land under it."""
    plane = []
    for level in (0.1, 0.5, 0.9, 3.0):
        options = ["--mode", "landscape", "--size", "120x90", "--set", f"level={level}"]
        ended = hqmodel("render", "fig17-two-hills", "-o", "land.png", *options)
        assert (ended.status, ended.err) == (0, "")
        pixels = picture("land.png")
        assert pixels.shape == (90, 120, 3)
        plane.append(np.count_nonzero(pixels[..., 2] - pixels[..., 0] > 8))
    assert plane[0] < plane[1] < plane[2]
    assert plane[3] > 0


def test_a_landscape_is_seen_from_where_one_likes_but_below(hqmodel: Command) -> None:
    land = ["render", "fig16-hill", "--mode", "landscape", "--size", "64x64"]
    angles = [("0", "30"), ("90", "30"), ("24", "90")]
    for azimuth, elevation in angles:
        assert hqmodel(*land, "-o", f"{azimuth}.png", "--azimuth", azimuth, "--elevation", elevation).status == 0
    assert len({picture(f"{azimuth}.png").tobytes() for azimuth, _ in angles}) == len(angles)
    ended = hqmodel(*land, "-o", "below.png", "--elevation", "-5")
    assert (ended.status, ended.err) == (2, "--elevation: expected 0 or more with --mode landscape, got -5\n")
    assert "below.png" not in files()
