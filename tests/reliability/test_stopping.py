"""Long work stopped at any moment: nothing is written, what was there stays, and nothing is left beside it."""

from __future__ import annotations

import threading
from importlib import import_module
from pathlib import Path

import pytest

from hqmodel.app.asks import ExportSettings, ImportSettings
from hqmodel.app.export import ExportJob
from hqmodel.app.importing import FitJob
from hqmodel.edit import new_scene


class Stopped(ExportJob):
    """An export that is stopped at its report of that number."""

    left: int

    def _report(self, progress: float, stage: str) -> None:
        assert progress >= self.progress, "it goes forward only"
        self.left -= 1
        if self.left < 0:
            self.cancel()
        super()._report(progress, stage)


@pytest.mark.parametrize("suffix", [".obj", ".3mf"])
def test_an_export_stopped_at_any_report_writes_nothing(tmp_path: Path, suffix: str, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / f"ball{suffix}"
    path.write_bytes(b"old")
    settings, number = ExportSettings(path, resolution=12), 0
    while True:
        monkeypatch.setattr(Stopped, "left", number, raising=False)
        job = Stopped(new_scene(), settings)
        job.wait(60)
        if not job.cancelled:
            break
        assert job.outcome is None
        assert path.read_bytes() == b"old"
        assert [item.name for item in tmp_path.iterdir()] == [path.name]
        number += 1
    assert path.read_bytes() != b"old"
    assert number > 12, "it reports while it meshes, joins, measures, and with every block it writes"


def test_a_fit_is_stopped_while_its_file_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    """Which can take long: nobody waits for it."""
    reading, end = threading.Event(), threading.Event()

    def slowly(_: Path) -> None:
        reading.set()
        end.wait()

    monkeypatch.setattr(import_module("hqmodel.fit"), "read", slowly)
    job = FitJob(ImportSettings(Path("cloud.ply")))
    reading.wait()
    job.cancel()
    job.wait()
    assert not job.running
    assert job.outcome is None
    end.set()
