"""An export in the background."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import replace
from time import perf_counter
from typing import TYPE_CHECKING, Any, BinaryIO, cast

from hqmodel import files
from hqmodel.model import Scene

from .asks import Exported, ExportSettings
from .jobs import Job

if TYPE_CHECKING:
    from hqmodel.mesh import Mesh


class ExportJob(Job[Exported]):
    """Writes the scene as a mesh; stopped, it leaves the file that was there before."""

    noun, aftermath = "Export", "nothing was written"

    def __init__(self, scene: Scene, settings: ExportSettings, wake: Callable[[], None] = lambda: None) -> None:
        self.settings = settings
        self._scene = scene
        super().__init__(wake)

    def _work(self) -> Exported:
        from hqmodel import mesh

        started = perf_counter()
        settings, suffix = self.settings, self.settings.path.suffix.lower()
        if settings.method == "radial":
            body = mesh.radial_quads(self._scene, settings.resolution, self._meshing)
        else:
            body = self._polygonized()
        report = mesh.report(body, lambda: self._report(0.9, "Measuring"))
        thin = mesh.thin_parts(self._scene, body.resolution or 0) if settings.method == "cubes" else []
        if thin:
            report["thinner_than_cells"] = ", ".join(self._scene.shapes[part.shape].name for part in thin)
            report["resolution_for_them"] = max(part.resolution for part in thin)
        if settings.tolerance is not None:
            report["within_tolerance"] = (mesh.sized(body, settings.size).surface_error or 0.0) <= settings.tolerance
        fitted = mesh.fitted(body, suffix, unit=settings.unit, size=settings.size, up=settings.up)
        if not settings.colors:
            fitted = replace(fitted, colors=None)
        if not settings.normals:
            fitted = replace(fitted, normals=None)
        self._report(0.95, "Writing")
        with files.atomic(settings.path) as stream:
            mesh.write(fitted, cast(BinaryIO, _Watched(stream, self._report)), suffix, self._scene.name)
            self._report(1.0, "Writing")
        return Exported(settings.path, perf_counter() - started, report)

    def _polygonized(self) -> Mesh:
        from hqmodel import mesh

        settings, scene = self.settings, self._scene
        if settings.tolerance is None:
            mesh.must_have_room(scene, settings.resolution, reducing=settings.target_faces is not None)
            return mesh.polygonize(scene, settings.resolution, self._meshing, target_faces=settings.target_faces)
        mesh.must_have_room(scene, mesh.USUAL_RESOLUTION, reducing=True)
        return mesh.polygonize(scene, progress=self._meshing, tolerance=mesh.in_world(scene, settings.tolerance, settings.size))

    def _meshing(self, share: float, doing: str) -> None:
        self._report(0.9 * share, doing)

    def _faults(self) -> type[Exception]:
        from hqmodel.mesh import MeshError

        return MeshError

    def _place(self) -> str:
        return str(self.settings.path)


class _Watched(io.BufferedIOBase):
    """A file that tells of every block written to it, so that even a long one can be stopped."""

    def __init__(self, stream: BinaryIO, report: Callable[[float, str], None]) -> None:
        self._stream = stream
        self._report = report

    def write(self, data: Any) -> int:
        self._report(0.95, "Writing")
        return self._stream.write(data)

    def tell(self) -> int:
        return self._stream.tell()

    def seek(self, offset: int, whence: int = 0) -> int:
        return self._stream.seek(offset, whence)

    def flush(self) -> None:
        self._stream.flush()
