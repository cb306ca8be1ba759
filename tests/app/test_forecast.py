"""What is told of an export before it is begun is near what it then comes to."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from hqmodel import memory, mesh
from hqmodel.app.asks import ExportSettings
from hqmodel.app.forecast import Forecast
from hqmodel.edit import new_scene
from hqmodel.model import Scene

from ..gpu.scenes import solid

UNITS = {"": 1.0, "k": 1e3, "M": 1e6, "G": 1e9}


def numbers(told: str) -> tuple[float, float]:
    """Triangles and bytes."""
    found = re.fullmatch(r"about ([\d.e+]+) (\w?) ?triangles, ([\d.e+]+) (\w?)B, within [\d.e-]+ of the longest side", told)
    assert found is not None, told
    return float(found[1]) * UNITS[found[2]], float(found[3]) * UNITS[found[4]]


@pytest.mark.parametrize("suffix", [".glb", ".stl", ".obj"])
def test_triangles_and_bytes_are_about_right(suffix: str, tmp_path: Path) -> None:
    forecast = Forecast(new_scene())
    settings = ExportSettings(tmp_path / f"ball{suffix}", resolution=150)
    assert forecast.told(settings) == "", "nothing is known yet"
    forecast.wait()
    faces, size = numbers(forecast.told(settings))
    body = mesh.polygonize(new_scene(), 150)
    with settings.path.open("wb") as stream:
        mesh.write(mesh.fitted(body, suffix), stream, suffix)
    assert faces == pytest.approx(len(body.faces), rel=0.15)
    assert size == pytest.approx(settings.path.stat().st_size, rel=0.25)


def test_a_reduced_mesh_has_what_it_is_reduced_to(tmp_path: Path) -> None:
    forecast = Forecast(new_scene())
    settings = ExportSettings(tmp_path / "ball.ply", target_faces=2000)
    forecast.told(settings)
    forecast.wait()
    assert numbers(forecast.told(settings))[0] == 2000


@pytest.mark.parametrize(("gamma", "share"), [(2.0, 5e-3), (20.0, 5e-3)])
def test_what_a_tolerance_takes_is_estimated(gamma: float, share: float, tmp_path: Path) -> None:
    scene = solid(gamma)
    settings = ExportSettings(tmp_path / "body.stl", tolerance=50 * share, size=50.0)
    forecast = Forecast(scene)
    forecast.told(settings)
    forecast.wait()
    told = re.fullmatch(r"perhaps ([\d.e+]+) (\w?) ?triangles, ([\d.e+]+) (\w?)B: an estimate, .*", forecast.told(settings))
    assert told is not None
    faces, size = float(told[1]) * UNITS[told[2]], float(told[3]) * UNITS[told[4]]
    body = mesh.polygonize(scene, tolerance=mesh.in_world(scene, 50 * share, 50.0), shading=False)
    assert len(body.faces) / 2 < faces < 2 * len(body.faces)
    assert size == pytest.approx(50 * faces, rel=0.1), "an STL has 50 bytes a triangle"


def test_what_finds_no_room_in_memory_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    forecast = Forecast(new_scene())
    settings = ExportSettings(tmp_path / "ball.ply", resolution=1024)
    forecast.told(settings)
    forecast.wait()
    monkeypatch.setattr(memory, "available", lambda: 1e9)
    assert forecast.told(settings).startswith("resolution: expected at most ")


def test_of_what_cannot_be_exported_nothing_is_told(tmp_path: Path) -> None:
    forecast = Forecast(Scene(shapes=()))
    settings = ExportSettings(tmp_path / "none.ply")
    forecast.told(settings)
    forecast.wait()
    assert forecast.told(settings) == ""
