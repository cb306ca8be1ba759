"""Softer and flatter: the exponents of a whole shape, or of some of its strips, multiplied together."""

from __future__ import annotations

from collections.abc import Collection

from hqmodel.model import FIELDS, Scene

from .paths import get, put_fields

_GAMMA = FIELDS["shapes[].strips[].gamma"]


def scale_exponents(scene: Scene, shape: int, factor: float, strips: Collection[int] | None = None) -> Scene:
    """Every exponent of the shape, or of these strips, times the factor; as far as the format permits.

    Below 1 rounds and at last pinches, above 1 sharpens. A group goes with its strips, as a whole. Raises EditError where the
    shape or a strip is not there.
    """
    old = get(scene, ("shapes", shape))
    chosen = range(len(old.strips)) if strips is None else strips
    groups = {get(scene, ("shapes", shape, "strips", index)).group for index in chosen} - {None}
    new = [
        strip.changed(gamma=_scaled(strip.gamma, factor)) if index in chosen or strip.group in groups else strip
        for index, strip in enumerate(old.strips)
    ]
    outer = {name: g.changed(gamma=_scaled(g.gamma, factor)) if name in groups else g for name, g in old.groups.items()}
    return put_fields(scene, ("shapes", shape), strips=tuple(new), groups=outer)


def _scaled(gamma: float, factor: float) -> float:
    return min(max(gamma * factor, _GAMMA.low), _GAMMA.high)
