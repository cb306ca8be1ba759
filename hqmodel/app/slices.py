"""The useful range of the slice t, worked out in the background: it takes a while for large scenes."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor

from hqmodel.edit.animation import Animation, Repeat, Sweep
from hqmodel.field import slice_range
from hqmodel.model import FIELDS, Scene, Shape

Range = tuple[float, float]


class SliceRange:
    """Where there is a body, as t goes; the slider's usual range until that is known, and where there is no end."""

    def __init__(self) -> None:
        self._worker = ThreadPoolExecutor(1, thread_name_prefix="slices")
        self._asked: tuple[Shape, ...] = ()
        self._answer: Future[Range | None] | None = None
        self._known: Range | None = None

    def of(self, scene: Scene, wake: Callable[[], None]) -> Range:
        """What is known so far; `wake` is called, from another thread, when there is more."""
        if self._answer is not None and self._answer.done():
            self._known, self._answer = self._answer.result(), None
        if self._answer is None and self._asked != scene.shapes:
            self._asked = scene.shapes
            self._answer = self._worker.submit(slice_range, scene)
            self._answer.add_done_callback(lambda _: wake())
        return self._known or FIELDS["slice"].slider


def sliding(span: Range, seconds: float, repeat: Repeat) -> Animation:
    """The slice led once through its range in so many seconds; there and back where it goes to and fro."""
    duration = 2 * seconds if repeat == "ping-pong" else seconds
    return Animation(name="Slice", duration=duration, easing="linear", repeat=repeat, sweeps=(Sweep(path="slice", values=span),))


def share_at(t: float, span: Range, repeat: Repeat) -> float:
    """The moment of `sliding` at which the slice is t, on its way up."""
    share = min(max((t - span[0]) / (span[1] - span[0]), 0.0), 1.0)
    return share / 2 if repeat == "ping-pong" else share % 1
