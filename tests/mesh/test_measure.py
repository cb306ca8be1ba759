"""What a report says of a mesh, in whatever pieces it is looked at; and that it can be stopped."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from hqmodel.mesh import Mesh, measure, polygonize, report

from ..cases import case


@cache
def body() -> Mesh:
    return polygonize(case("two_holes").scene, 48)


@pytest.fixture(params=[50, 1 << 20])
def at_once(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> int:
    monkeypatch.setattr(measure, "_AT_ONCE", request.param)
    return int(request.param)


def test_closed_bodies(at_once: int) -> None:
    told = report(body())
    assert (told["watertight"], told["euler_number"]) == (True, -4)
    spanned = np.linalg.det(body().vertices[body().faces])
    assert told["volume"] == pytest.approx(spanned.sum() / 6, rel=1e-9)


@pytest.mark.parametrize("faces", [slice(1, None), slice(0, 0)])
def test_open_ones(at_once: int, faces: slice) -> None:
    """A face gone is a hole: that takes one from the Euler number."""
    told = report(Mesh(body().vertices, body().faces[faces]))
    assert not told["watertight"]
    assert told["euler_number"] == (len(body().vertices) if faces.stop == 0 else -5)


def test_a_face_turned_round_is_not_closed(at_once: int) -> None:
    faces = body().faces.copy()
    faces[100] = faces[100, ::-1]
    told = report(Mesh(body().vertices, faces))
    assert (told["watertight"], told["euler_number"]) == (False, -4)


def test_it_can_be_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(measure, "_AT_ONCE", len(body().faces) // 5)
    looks = []
    report(body(), lambda: looks.append(1))
    assert len(looks) >= 10, "five times over its faces, and five over its edges"

    def stop() -> None:
        raise InterruptedError

    with pytest.raises(InterruptedError):
        report(body(), stop)
