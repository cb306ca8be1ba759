"""What a film shows, and its frames drawn: each moment once, from one distance."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image

from hqmodel import gpu
from hqmodel.edit import Animation, filmed, staged
from hqmodel.field import Plane, Region, region
from hqmodel.model import Camera, Scene

from .writing import Film, Report, write

# Samples a pixel: few, as a frame is seen for a moment.
_SAMPLES = 4
# The share of the work that drawing is; the rest is writing.
_DRAWING = 0.9

# The phase of the animation, and the degrees that the turntable has turned.
Moment = tuple[float, float]
Shown = tuple[Scene, Region, Camera]


@dataclass(frozen=True)
class Plan:
    """A scene seen by a camera, in motion by an animation or turned once around, or both, in so many frames over so many seconds.

    `size` is (width, height) in pixels. `whole`: seen from so far that all of the body is in every frame, else from where the
    camera is. What lies in front of the plane `cut` is left out.
    """

    scene: Scene
    camera: Camera
    moving: Animation | None
    turning: bool
    frames: int
    seconds: float
    size: tuple[int, int]
    mode: str = "clay"
    whole: bool = True
    cut: Plane | None = None

    @property
    def moments(self) -> list[Moment]:
        """Each frame's."""
        phases = self.moving.phases(self.frames) if self.moving else [0.0] * self.frames
        turns = [360 * index / self.frames if self.turning else 0.0 for index in range(self.frames)]
        return list(zip(phases, turns, strict=True))

    @property
    def loops(self) -> bool:
        """Whether it goes on after its end."""
        return self.turning or self.moving is None or self.moving.repeat != "once"


def shoot(plan: Plan, path: Path, report: Report = lambda *_: None) -> list[Path]:
    """Draw the film and write it as its ending says; the files that it made.

    `report` is told the share done (0..1) and what is being done; whatever it raises ends the work, and nothing is written.
    Raises EditError where the animation makes no scene, GpuError without OpenGL, FilmError and OSError where it can't be written.
    """
    moments = plan.moments
    with TemporaryDirectory(prefix="hqmodel-") as folder:
        shown = _shown(plan, list(dict.fromkeys(moments)), report)
        drawn = _drawn(plan, shown, Path(folder), lambda share, doing: report(_DRAWING * share, doing))
        number = {moment: index for index, moment in enumerate(drawn)}
        film = Film(list(drawn.values()), [number[moment] for moment in moments], plan.seconds, plan.loops)
        return write(film, path, lambda share, doing: report(_DRAWING + (1 - _DRAWING) * share, doing))


def _shown(plan: Plan, moments: list[Moment], report: Report) -> dict[Moment, Shown]:
    """The scene, its region and the camera at each moment."""
    moving, phases = plan.moving, list(dict.fromkeys(phase for phase, _ in moments))
    stages = {phase: staged(plan.scene, moving, phase) if moving else plan.scene for phase in phases}
    known: dict[int, Region] = {}
    for stage in stages.values():
        report(0.0, "Measuring")
        if id(stage) not in known:
            known[id(stage)] = region(stage)
    cameras = {}
    for phase, turn in moments:
        seen = filmed(plan.camera, moving, phase) if moving else plan.camera
        cameras[phase, turn] = replace(seen, azimuth=seen.azimuth + turn)
    if plan.whole:
        cameras = _framing(cameras, list(known.values()), plan.size[0] / plan.size[1])
    return {moment: (stages[moment[0]], known[id(stages[moment[0]])], camera) for moment, camera in cameras.items()}


def _framing(cameras: dict[Moment, Camera], regions: list[Region], aspect: float) -> dict[Moment, Camera]:
    """One target and one distance, from which all of all bodies is seen."""
    boxes = [where for where in regions if not where.empty] or regions
    low = [min(where.low[axis] for where in boxes) for axis in range(3)]
    high = [max(where.high[axis] for where in boxes) for axis in range(3)]
    framed = {moment: camera.framing(low, high, aspect) for moment, camera in cameras.items()}
    distance = max(camera.distance for camera in framed.values())
    return {moment: replace(camera, distance=distance) for moment, camera in framed.items()}


def _drawn(plan: Plan, shown: dict[Moment, Shown], folder: Path, report: Report) -> dict[Moment, Path]:
    """Each moment's picture as a file."""
    files: dict[Moment, Path] = {}
    ctx = gpu.offscreen()
    try:
        for index, (moment, (scene, where, camera)) in enumerate(shown.items()):

            def told(share: float, _: str, done: int = index) -> None:
                report((done + share) / len(shown), "Drawing")

            told(0.0, "")
            pixels = gpu.render(scene, camera, plan.size, plan.mode, plan.cut, _SAMPLES, ctx, told, where)
            files[moment] = folder / f"{index}.png"
            Image.fromarray(pixels[..., :3]).save(files[moment], compress_level=1)
    finally:
        ctx.release()
    return files
