"""Drawings, read back by other programs' eyes: an XML parser with paths followed by hand, and ezdxf."""

from __future__ import annotations

import io
import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from ezdxf.entities.lwpolyline import LWPolyline
from ezdxf.filemanagement import readfile
from numpy.typing import NDArray

from hqmodel.files import load
from hqmodel.outline import Outline, Plane, outline, write
from hqmodel.outline.curves import enclosed

SVG = "{http://www.w3.org/2000/svg}"


def drawing(drawn: Outline, ending: str, unit: str | None = None) -> bytes:
    stream = io.BytesIO()
    write(drawn, stream, ending, unit)
    return stream.getvalue()


def chains(path: str) -> list[NDArray[np.float64]]:
    """The curves of a path of M, C and Z."""
    found = []
    for part in path.split("Z")[:-1]:
        numbers = np.array(re.findall(r"-?[\d.]+", part), dtype=float).reshape(-1, 2)
        assert re.sub(r"[-\d. ]", "", part) == "M" + "C" * ((len(numbers) - 1) // 3)
        starts = numbers[:-1:3]
        found.append(np.stack([starts, numbers[1::3], numbers[2::3], numbers[3::3]], axis=1))
    return found


def test_svg_has_the_outline_the_right_way_up_in_its_unit() -> None:
    drawn = outline(load("mug"), Plane((0, -1, 0)))
    size = float(np.max(drawn.bounds[1] - drawn.bounds[0]))
    drawn = drawn.scaled(80 / size)
    tree = ElementTree.fromstring(drawing(drawn, ".svg", "mm"))
    low, high = drawn.bounds
    box = np.array(tree.attrib["viewBox"].split(), dtype=float)
    assert tree.attrib["width"].endswith("mm")
    assert float(tree.attrib["width"].removesuffix("mm")) == box[2] == pytest.approx(high[0] - low[0], rel=0.05)
    path = tree.find(f"{SVG}path")
    assert path is not None
    curves = chains(path.attrib["d"])
    assert -sum(map(enclosed, curves)) == pytest.approx(drawn.area, rel=1e-4)  # v points down in SVG
    nodes = np.concatenate(curves).reshape(-1, 2)
    assert np.all((nodes >= box[:2]) & (nodes <= box[2:]))
    handle = max(curves, key=len)
    rightmost = handle[np.argmax(handle[:, 0, 0]), 0]
    assert rightmost[0] > 0.9 * box[2]  # the mug's handle is at +x, which is to the right


def test_metres_become_millimetres_and_no_unit_pixels() -> None:
    drawn = outline(load("hex-nut"))
    metres = ElementTree.fromstring(drawing(drawn, ".svg", "m"))
    assert metres.attrib["height"].endswith("mm")
    assert float(metres.attrib["height"].removesuffix("mm")) > 1000
    assert ElementTree.fromstring(drawing(drawn, ".svg")).attrib["height"] == "1000"


@pytest.mark.parametrize(("unit", "code"), [("mm", 4), ("cm", 5), ("m", 6), ("in", 1), (None, 0)])
def test_dxf_has_closed_polylines_and_names_its_unit(tmp_path: Path, unit: str | None, code: int) -> None:
    drawn = outline(load("hex-nut"))
    file = tmp_path / "nut.dxf"
    file.write_bytes(drawing(drawn, ".dxf", unit))
    document = readfile(file)
    assert document.units == code
    assert not document.audit().errors
    lines = [line for line in document.modelspace() if isinstance(line, LWPolyline)]
    assert len(lines) == len(document.modelspace()) == 2
    assert all(line.closed for line in lines)
    total = 0.0
    for line in lines:
        x, y = np.array([(point[0], point[1]) for point in line.get_points()]).T
        total += float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    assert total == pytest.approx(drawn.area, rel=1e-3)
