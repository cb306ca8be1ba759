"""figures: a picture of each figure asked for, and a page that needs nothing else."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from hqmodel.cli import plates
from hqmodel.cli.plates import landscape
from hqmodel.edit import Animation, Sweep
from hqmodel.field import Terms, value
from hqmodel.files import builtin, load

from .conftest import Command, files

Picture = NDArray[np.int64]
SIZE = 40


class Page(HTMLParser):
    """The page's tags, all of them closed in order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.addresses: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.addresses += [value or "" for name, value in attrs if name in ("src", "href")]
        if tag not in ("img", "meta", "link", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def picture(path: Path) -> Picture:
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB"), dtype=np.int64)


def test_each_figure_asked_for_is_drawn_and_explained(hqmodel: Command) -> None:
    ended = hqmodel("figures", "-o", "out", "--only", "3", "--only", "12", "--only", "fig16", "--size", SIZE, "--json")
    assert (ended.status, ended.err) == (0, "")
    names = ["fig03-triangle", "fig12-cuboctahedron", "fig16-hill"]
    assert json.loads(ended.out)["files"] == [*(f"out/{name}.png" for name in names), "out/index.html"]
    text = Path("out/index.html").read_text(encoding="utf-8")
    page = Page(text)
    assert page.open == []
    for name in names:
        preset = next(preset for preset in builtin() if preset.name == name)
        assert preset.description.split(". ")[0] in text
        assert Path(f"out/presets/{name}.json").read_bytes() == preset.path.read_bytes()
        assert picture(Path(f"out/{name}.png")).shape[1] > 3 * SIZE
    for address in page.addresses:
        assert (f'id="{address[1:]}"' in text) if address[0] == "#" else Path("out", address).is_file()
    assert not re.search(r"https?:|//", text)
    assert {path.name for path in Path("out").iterdir()} == {*(f"{name}.png" for name in names), "index.html", "presets"}


def test_stages_stand_in_a_row_and_long_rows_are_broken() -> None:
    def stage(shade: int) -> plates.Panel:
        return plates.Panel(lambda size: Image.new("RGB", size, (shade, 0, 0)), [("t", True), (" = 1", False)])

    pixels = np.asarray(plates.sheet("Figure 0: test", [[stage(10 * i) for i in range(1, 8)]], SIZE, lambda _: None))
    found = {shade: np.argwhere(np.all(pixels == (shade, 0, 0), axis=-1)) for shade in range(10, 80, 10)}
    assert all(len(places) == SIZE**2 for places in found.values())
    corners = [tuple(places[0]) for places in found.values()]
    assert [row for row, _ in corners] == sorted(row for row, _ in corners)
    assert len({row for row, _ in corners}) == 2
    assert [column for _, column in corners[:4]] == sorted(column for _, column in corners[:4])


def test_an_outline_fills_as_much_of_a_stage_as_its_area_says() -> None:
    scene = load("fig01-superellipse")
    (row,) = plates.panels(scene, None)  # type: ignore[arg-type]
    areas = []
    for panel in row[1:3]:  # the circle and the diamond, of which lines and shades are all that is darker than the ground
        pixels = np.asarray(panel.draw((100, 100)), dtype=int)
        areas.append(np.count_nonzero(pixels.sum(axis=-1) < 450))
    assert areas[0] / areas[1] == pytest.approx(np.pi / 2, rel=0.05)


def test_labels_have_the_paper_s_letters() -> None:
    gammas = tuple(Sweep(path=f"shapes[0].strips[{i}].gamma", values=(2.0, 10.0 * i + 2)) for i in range(2))
    slices = Sweep(path="slice", values=(-1.0, 1.0))
    told = plates.label(Animation(sweeps=(*gammas, slices)), 1.0)
    assert "".join(run for run, _ in told) == "γ = 2, 12, t = 1"
    assert [run for run, slanted in told if slanted] == ["γ", "t"]


def test_the_land_is_as_high_as_the_sum_and_cut_where_the_section_is() -> None:
    scene = load("fig18-hill-less-hill")
    terms = Terms.of(scene)
    land = landscape.land_of(scene, np.array([-1.0, -1.0]), np.array([1.0, 1.0]))
    flat = land.corners.reshape(-1, 3) * [1, 1, 0]
    np.testing.assert_allclose(land.corners.reshape(-1, 3)[:, 2], value(terms, flat) + scene.level, atol=1e-12)
    whole, above, below = (
        sum(_area(polygon) for polygon, _ in landscape.pieces(land, level, side))
        for level, side in ((-9.0, False), (scene.level, False), (scene.level, True))
    )
    assert above + below == pytest.approx(whole)
    assert whole == pytest.approx(np.prod(land.high - land.low))


def _area(polygon: NDArray[np.float64]) -> float:
    x, y = polygon[:, :2].T
    return abs(float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))) / 2


@pytest.mark.parametrize("name", ["20", "0", "fig99", "cat"])
def test_a_figure_that_is_none(hqmodel: Command, name: str) -> None:
    ended = hqmodel("figures", "-o", "out", "--only", name)
    assert ended.status == 2
    assert ended.err.startswith("--only: expected a figure from 1 to 19 or a part of a figure's name, got ")
    assert files() == {"ball.json"}


@pytest.mark.parametrize("folder", ["ball.json", "none/out"])
def test_a_folder_that_cannot_be(hqmodel: Command, folder: str) -> None:
    ended = hqmodel("figures", "-o", folder, "--only", "1")
    assert (ended.status, ended.out, files()) == (2, "", {"ball.json"})
    assert ended.err.startswith(f"{folder}: expected a folder, or the name of a new one")


def test_what_is_stopped_leaves_nothing(hqmodel: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(plates, "page", interrupted)
    assert hqmodel("figures", "-o", "out", "--only", "4", "--size", SIZE).status == 130
    assert files() == {"ball.json"}
