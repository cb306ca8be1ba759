"""Parts and grooves that a grid misses are named, and what is named to find them finds them."""

from __future__ import annotations

import pytest
from scipy.spatial.transform import Rotation

from hqmodel.files import builtin, load
from hqmodel.mesh import Thin, polygonize, report, thin_parts
from hqmodel.model import Scene, Shape, Strip, Transform

from ..cases import NAMES, case

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
BALL = 4.18879


def plate(half: float, turn: tuple[float, float, float], **more: float) -> Shape:
    """A plate 2 by 2, turned by a rotation vector."""
    x, y, z, w = Rotation.from_rotvec(turn).as_quat().tolist()
    strips = tuple(Strip(normal=n, gamma=60.0, half_width=width) for n, width in ((X, 1.0), (Y, 1.0), (Z, half)))
    return Shape(strips=strips, hardness=20.0, transform=Transform(rotation=(x, y, z, w))).changed(**more)


def ball(at: float, scale: float = 1.0) -> Shape:
    placed = Transform(translation=(at, 0.0, 0.0), scale=(scale, scale, scale))
    return Shape(strips=tuple(Strip(normal=n) for n in (X, Y, Z)), hardness=20.0, transform=placed)


@pytest.mark.parametrize("turn", [(0.3, 0.2, 0.1), (0.6, 0.6, 0.3), (0.0, 0.0, 0.7)])
@pytest.mark.parametrize("half", [0.04, 0.02, 0.01])
def test_a_plate_is_named_where_the_mesh_lacks_some_of_it(turn: tuple[float, float, float], half: float) -> None:
    scene = Scene(shapes=(ball(3.0), plate(half, turn)))

    def there(resolution: int) -> float:
        return float((report(polygonize(scene, resolution, shading=False))["volume"] - BALL) / (8 * half))

    found = thin_parts(scene, 96)
    if not found:
        assert there(96) > 0.9
        return
    ((shape, resolution),) = found
    assert shape == 1
    assert there(96) < 0.95
    assert there(resolution) > 0.95
    assert not thin_parts(scene, resolution)


def test_a_groove_is_named() -> None:
    scene = Scene(shapes=(ball(0.0), plate(0.006, (0.3, 0.2, 0.1), coefficient=-1.0)))
    assert [part.shape for part in thin_parts(scene, 64)] == [1]
    assert thin_parts(scene, 300) == []


def test_what_is_thin_but_within_a_body_or_of_no_effect_is_not_named() -> None:
    hidden = plate(0.003, (0.3, 0.2, 0.1))
    assert thin_parts(Scene(shapes=(ball(0.0, 2.0), hidden)), 64) == []
    assert thin_parts(Scene(shapes=(ball(9.0), hidden.changed(coefficient=-1.0))), 64) == []
    assert thin_parts(Scene(shapes=()), 64) == []


def test_a_sheet_without_end_is_named_within_its_bounds() -> None:
    sheet = Shape(strips=(Strip(normal=(0.3, 0.5, 1.0), half_width=0.004, gamma=8.0),))
    (found,) = thin_parts(Scene(shapes=(sheet,), bounds=((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0))), 64)
    assert found == Thin(0, found.resolution)
    assert 200 < found.resolution < 400


def test_nothing_is_named_in_vain() -> None:
    """Of the built-in presets and the reference cases all have whole meshes as they are exported."""
    scenes = [load(preset.path) for preset in builtin()] + [case(name).scene for name in NAMES]
    assert [scene.name for scene in scenes if thin_parts(scene)] == []
