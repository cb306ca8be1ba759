"""A cloud and what was fitted to it in one picture: the points, coloured by distance, beside the body."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from hqmodel.model import Camera, Scene

from .faults import MACHINE, Fault
from .progress import progress

if TYPE_CHECKING:
    from PIL.Image import Image

SIZE = 640, 480
# Distances, as shares of the diagonal, at which points are fully blue (within the body) or red (outside).
_FULL = 0.01
_PAPER, _NEAR, _INSIDE, _OUTSIDE = ((244, 243, 240), (150, 150, 146), (38, 98, 200), (206, 52, 40))
_MOST_POINTS = 60_000


def compared(scene: Scene, points: NDArray[np.float64], residuals: NDArray[np.float64], diagonal: float, quiet: bool) -> Image:
    """The points (N, 3) on the left, grey where they lie on the surface, blue within and red outside; on the right the scene.

    Raises Fault without OpenGL.
    """
    from PIL import Image

    from hqmodel import gpu

    low, high = np.quantile(points, (0.005, 0.995), axis=0)
    camera = Camera().framing(low, high, SIZE[0] / SIZE[1])
    step = len(points) // _MOST_POINTS + 1
    cloud = _dots(points[::step], residuals[::step] / diagonal, camera)
    try:
        with progress(quiet) as report:
            body = gpu.render(scene, camera, SIZE, samples=4, progress=report)[..., :3]
    except gpu.GpuError as error:
        raise Fault(str(error), MACHINE) from None
    return Image.fromarray(np.concatenate([cloud, body], axis=1))


def _dots(points: NDArray[np.float64], away: NDArray[np.float64], camera: Camera) -> NDArray[np.uint8]:
    """The points as dots of 2 x 2 pixels, the nearest on top."""
    from PIL import Image

    width, height = SIZE
    back_to_front = np.argsort(points @ camera.axes()[2])
    at = camera.project(points[back_to_front], SIZE)
    seen = np.isfinite(at).all(axis=1) & (at >= 0).all(axis=1) & (at < (width - 1, height - 1)).all(axis=1)
    x, y = at[seen].astype(int).T
    colors = _colors(away[back_to_front][seen])
    picture = np.array(Image.new("RGB", SIZE, _PAPER))
    for dx, dy in ((0, 0), (1, 0), (0, 1), (1, 1)):
        picture[y + dy, x + dx] = colors
    return picture


def _colors(away: NDArray[np.float64]) -> Any:
    share = np.clip(np.abs(away) / _FULL, 0.0, 1.0)[:, None]
    end = np.where(away[:, None] > 0, _OUTSIDE, _INSIDE)
    return (np.array(_NEAR) * (1 - share) + end * share).astype(np.uint8)
