"""What lies under the cursor."""

from __future__ import annotations

import numpy as np

from hqmodel.field import Region, Terms, first_hits, shaping_strip
from hqmodel.model import Camera, Scene

Pair = tuple[int, int]


def picked(scene: Scene, region: Region, camera: Camera, pixel: tuple[float, float], size: Pair) -> Pair | None:
    """The shape, and the strip in it, that a pixel of a picture of that size shows; None beside the body."""
    terms = Terms.of(scene)
    origin, direction = camera.rays(pixel, size)
    distance = first_hits(terms, region, origin, direction)[0]
    if np.isnan(distance):
        return None
    strip = shaping_strip(terms, origin + direction * distance)
    shape, index = terms.strip_source[int(strip)]
    return int(shape), int(index)
