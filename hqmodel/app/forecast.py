"""What an export will come to, before it is begun: judged by a coarse mesh that is made in the background."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from io import BytesIO
from typing import TYPE_CHECKING

from hqmodel.field import Terms
from hqmodel.model import Scene

from .asks import ExportSettings

if TYPE_CHECKING:
    from hqmodel.mesh import Bending, Count

Kind = tuple[str, bool, bool]


@dataclass(frozen=True)
class Coarse:
    """What the coarse mesh came to: triangles, bytes for each in the format, error as a share of its longest side, and how it
    bends."""

    count: Count
    size: float
    error: float
    bending: Bending


class Forecast:
    """Tells of exports of one scene. `wake` is called, from another thread, when there is more to tell."""

    def __init__(self, scene: Scene, wake: Callable[[], None] = lambda: None) -> None:
        self._scene, self._wake = scene, wake
        self._known: dict[Kind, Coarse | None] = {}
        self._busy: threading.Thread | None = None

    def told(self, settings: ExportSettings) -> str:
        """About how many triangles, how large a file, how true; or why it can't be; empty as long as that is not known."""
        kind = settings.path.suffix.lower(), settings.colors, settings.normals
        if kind not in self._known:
            if self._busy is None or not self._busy.is_alive():
                self._busy = threading.Thread(target=self._look, args=(kind,), daemon=True)
                self._busy.start()
            return ""
        coarse = self._known[kind]
        if coarse is None:
            return ""
        return _told(coarse, settings) if settings.tolerance is None else _told_within(coarse, settings, settings.tolerance)

    def wait(self) -> None:
        """Until what is being worked out is known."""
        if self._busy is not None:
            self._busy.join()

    def _look(self, kind: Kind) -> None:
        from hqmodel import mesh

        suffix, colors, normals = kind
        try:
            body = mesh.polygonize(self._scene, mesh.COARSE)
            bending = mesh.Bending.of(Terms.of(self._scene), body)
            shaded = replace(body, colors=body.colors if colors else None, normals=body.normals if normals else None)
            stream = BytesIO()
            mesh.write(mesh.fitted(shaded, suffix), stream, suffix)
            error = (body.surface_error or 0.0) / bending.side
            self._known[kind] = Coarse(mesh.Count.of(body), len(stream.getvalue()) / len(body.faces), error, bending)
        except mesh.MeshError:
            self._known[kind] = None  # the export itself will say why
        finally:
            self._wake()


def _told(coarse: Coarse, settings: ExportSettings) -> str:
    """A smooth surface's error goes with the size of its triangles."""
    from hqmodel import mesh

    every = coarse.count.at(settings.resolution)
    faces = min(every, settings.target_faces or every)
    error = coarse.error * sum(coarse.count) / faces
    lack = mesh.lack_of_room(coarse.count, settings.resolution, settings.target_faces is not None)
    return lack or f"about {_short(faces)} triangles, {_short(coarse.size * faces)}B, within {error:.2g} of the longest side"


def _told_within(coarse: Coarse, settings: ExportSettings, tolerance: float) -> str:
    """How many triangles that takes is less sure than how many a resolution gives; but there are no more than that."""
    share = tolerance / (settings.size or coarse.bending.side)
    faces = min(coarse.bending.faces(share), coarse.count.at(coarse.bending.cells(share)))
    return f"perhaps {_short(faces)} triangles, {_short(coarse.size * faces)}B: an estimate, by how the body bends"


def _short(number: float) -> str:
    """Two digits and a word that people know: 1.2 M."""
    for unit, word in ((1e9, " G"), (1e6, " M"), (1e3, " k")):
        if number >= unit:
            return f"{number / unit:.2g}{word}" if number < 100 * unit else f"{number / unit:.0f}{word}"
    return f"{number:.0f} "
