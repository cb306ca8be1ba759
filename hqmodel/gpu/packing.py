"""From the scene's terms in float64 to the rows that the GPU reads in float32.

The world is first moved so that the region's centre lies at the origin and scaled so that its longest half-side is 1: a model
far from the origin, or of 1e-4 or 1e4 in size, loses nothing that float32 has.
"""

from __future__ import annotations

from colorsys import hsv_to_rgb
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hqmodel.field import Region, Terms, reaches, srgb_to_linear
from hqmodel.model import Scene

from .layout import STRIP, TERM, WIDTH

Array = NDArray[np.float64]
# The largest number that is packed: products of two of them, and sums of those, stay inside float32.
LIMIT = 1e18
# Terms that add up to less than this share of the level move the surface by less than can be seen.
NEGLIGIBLE = 1e-7
_GOLDEN = 0.61803398875


@dataclass(frozen=True, eq=False)
class Frame:
    """The GPU's unit frame: x = centre + scale * local."""

    centre: Array
    scale: float

    @classmethod
    def of(cls, region: Region) -> Frame:
        return cls(region.centre, float(np.max(region.size)) / 2 or 1.0)

    def local(self, points: ArrayLike) -> Array:
        """World points (..., 3) in the unit frame."""
        result: Array = (np.asarray(points, dtype=float) - self.centre) / self.scale
        return result


@dataclass(frozen=True, eq=False)
class Packed:
    """What goes to the GPU: the rows, and what is said once for the whole scene."""

    terms: NDArray[np.void]
    strips: NDArray[np.void]
    uniforms: dict[str, float | int]
    defines: tuple[str, ...]  # what march.glsl is compiled for

    @property
    def length(self) -> int:
        """How many texels the rows take."""
        return len(self.terms) * TERM.texels + len(self.strips) * STRIP.texels

    def texels(self, more: NDArray[np.float32] | None = None) -> NDArray[np.float32]:
        """The texture's content, (lines, WIDTH, 4): the rows, and then `more` texels (n, 4)."""
        parts = [rows.view(np.float32).ravel() for rows in (self.terms, self.strips)]
        flat = np.concatenate([*parts, *([] if more is None else [more.ravel()])])
        lines = max(1, -(-flat.size // (4 * WIDTH)))
        whole = np.zeros(lines * WIDTH * 4, dtype=np.float32)
        whole[: flat.size] = flat
        return whole.reshape(lines, WIDTH, 4)


def pack(scene: Scene, terms: Terms, frame: Frame) -> Packed:
    """The rows of a scene's terms, in the unit frame."""
    first_strip = terms.group_start[terms.term_start]
    uniforms: dict[str, float | int] = {
        "term_count": len(terms),
        "term_rows": 0,
        "strip_rows": len(terms) * TERM.texels,
        "level_sign": float(np.sign(terms.level)),
        "level_log": float(np.log(abs(terms.level))) if terms.level else 0.0,
    }
    defines = []
    if terms.grouped:
        defines.append("GROUPS")
    if terms.hyperbolic:
        defines.append("HYPERBOLIC")
    if not np.all(terms.positive):
        defines.append("CARVING")
    if _is_lone(terms):
        defines.append("LONE")
        slack = (terms.log_coefficient[0] - np.log(terms.level)) / max(terms.hardness[0], 1e-300)
        uniforms["lone_constant"] = float(np.clip(terms.constant[0] + slack, -LIMIT, LIMIT))
        if np.all(terms.outer >= 1) and np.all(terms.inner >= 1):
            defines.append("CONVEX")
            uniforms["least_exponent"] = float(np.min(terms.outer))
    elif len(terms):
        defines.append("CELLS")
    strips = _strip_rows(scene, terms, frame)
    return Packed(_term_rows(scene, terms, first_strip, strips), strips, uniforms, tuple(defines))


def tint(number: int) -> tuple[float, float, float]:
    """The colour, sRGB, that a strip has in the strips mode: neighbours in number differ widely in hue."""
    return hsv_to_rgb((0.06 + number * _GOLDEN) % 1.0, 0.62, 0.92)


def _is_lone(terms: Terms) -> bool:
    """Whether the body is one elliptic shape."""
    return len(terms) == 1 and terms.level > 0 and not terms.hyperbolic and bool(terms.positive[0])


def _term_rows(scene: Scene, terms: Terms, first_strip: NDArray[np.intp], strips: NDArray[np.void]) -> NDArray[np.void]:
    rows = np.zeros(len(terms), dtype=TERM.dtype)
    rows["first"] = first_strip
    rows["count"] = np.diff(first_strip, append=len(terms.inner))
    rows["hardness"] = np.clip(terms.hardness, 0, LIMIT)
    rows["constant"] = np.clip(terms.constant, -LIMIT, LIMIT)
    rows["log_coefficient"] = terms.log_coefficient
    rows["adds"] = np.sign(terms.coefficient)
    if len(terms):
        rows["hyperbolic"] = np.minimum.reduceat(terms.group_sign, terms.term_start) < 0
    rows["color"] = srgb_to_linear(np.array([scene.shapes[shape].color for shape in terms.term_source])).reshape(-1, 3)
    rows["low"], rows["high"] = -LIMIT, LIMIT
    for count in np.unique(rows["count"]):
        chosen = np.flatnonzero(rows["count"] == count)
        own = strips[first_strip[chosen][:, None] + np.arange(int(count))]
        rows["low"][chosen], rows["high"][chosen] = _boxes(*(own[name].astype(float) for name in ("normal", "offset", "reach")))
    return rows


def _boxes(normal: Array, offset: Array, reach: Array) -> tuple[Array, Array]:
    """Low and high corners, (k, 3) each, of boxes around |normal . x + offset| <= reach, from (k, s, 3), (k, s) and (k, s).

    With M the pseudo-inverse of the planes divided by their reach, |x + M offset / reach| <= sum |M|.
    """
    inside = np.maximum(reach, 1e-12)
    planes = normal / inside[..., None]
    size = np.linalg.svd(planes, compute_uv=False)
    bounded = (reach.max(axis=1) < LIMIT) & (size.shape[1] == 3) & (size[:, -1] > 1e-9 * size[:, 0])
    inverse = np.linalg.pinv(np.where(bounded[:, None, None], planes, 0.0))
    middle = -np.einsum("kis,ks->ki", inverse, offset / inside)
    half = np.sum(np.abs(inverse), axis=2) * (1 + 1e-5) + 1e-6
    half = np.where(bounded[:, None], half, LIMIT)
    return np.clip(middle - half, -LIMIT, LIMIT), np.clip(middle + half, -LIMIT, LIMIT)


def _strip_rows(scene: Scene, terms: Terms, frame: Frame) -> NDArray[np.void]:
    rows = np.zeros(len(terms.inner), dtype=STRIP.dtype)
    normal = terms.normal * frame.scale
    offset = terms.normal @ frame.centre + terms.offset
    size = np.maximum(np.max(np.abs(normal), axis=1, initial=0.0), np.abs(offset))
    shrink = np.minimum(1.0, LIMIT / np.maximum(size, 1.0))
    rows["normal"], rows["offset"] = normal * shrink[:, None], offset * shrink
    rows["inner"] = terms.inner
    rows["outer"] = terms.outer[terms.group_of_strip]
    rows["sigma"] = terms.group_sign[terms.group_of_strip]
    rows["members"][terms.group_start] = np.diff(terms.group_start, append=len(terms.inner))
    before = np.cumsum([0, *(len(shape.strips) for shape in scene.shapes)])
    shape, index = terms.strip_source.T
    rows["tint"] = srgb_to_linear(np.array([tint(int(number)) for number in before[shape] + index])).reshape(-1, 3)
    rows["reach"] = _reaches(terms)
    return rows


def _reaches(terms: Terms) -> Array:
    """(S,) the largest |h| at which a strip's term is more than negligible beside the level: T >= ln w - ln (K / NEGLIGIBLE).

    For a lone shape the largest |h| on its surface. Limitless for hyperbolic terms, and where there is no level to measure by.
    """
    margin = 0.0 if _is_lone(terms) else np.log(max(len(terms), 1) / NEGLIGIBLE)
    reach = reaches(terms, margin)
    return np.where(reach > 0, np.minimum(reach * (1 + 1e-6), LIMIT), -1.0)
