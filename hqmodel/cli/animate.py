"""hqmodel animate: a sweep of any numbers, or a turn about the body, as a film."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from hqmodel.edit import Animation, EditError, animation_at, filmed, staged, sweep_of
from hqmodel.model import Camera, Scene, remembered, shown, usual

from .faults import INPUT, MACHINE, USAGE, Fault
from .options import Json, Preset, Quiet, Set, Slice, scene_of
from .outputs import checked, tell
from .progress import Report, progress
from .views import Azimuth, Elevation, Mode, Size, View, drawable, looking, pixels

if TYPE_CHECKING:
    from hqmodel.field import Region

FPS = 25.0
_MOST = 10_000
# Samples a pixel: few, as a frame is seen for a moment.
_SAMPLES = 4
# The seconds of what has no duration of its own.
_SWEPT, _TURNED = 4.0, 6.0

Moment = tuple[float, float]

Output = Annotated[
    Path,
    typer.Option("-o", "--output", metavar="FILE", help="The film: .gif, .mp4 (by ffmpeg), or .png for numbered frames (####)."),
]
Sweeps = Annotated[
    list[str] | None,
    typer.Option("--sweep", metavar="PATH=A:B", help="Lead a field from A to B, or on to more values; may be repeated."),
]
Name = Annotated[str | None, typer.Option("--animation", metavar="NAME", help="One of the preset's animations; else its first.")]
Turntable = Annotated[bool, typer.Option("--turntable", help="Turn once about the body.")]
Seconds = Annotated[float | None, typer.Option("--seconds", metavar="S", help="How long one round takes.")]
Fps = Annotated[float | None, typer.Option("--fps", metavar="N", help=f"Frames a second; {FPS:g} unless said.")]
Frames = Annotated[int | None, typer.Option("--frames", metavar="N", help="How many frames one round has.")]
Easing = Annotated[Literal["linear", "smooth"] | None, typer.Option("--easing", help="Steadily, or resting at each value.")]
PingPong = Annotated[bool, typer.Option("--ping-pong", help="There and back again.")]


def animate(
    preset: Preset,
    output: Output,
    sweep: Sweeps = None,
    animation: Name = None,
    turntable: Turntable = False,
    seconds: Seconds = None,
    fps: Fps = None,
    frames: Frames = None,
    easing: Easing = None,
    ping_pong: PingPong = False,
    size: Size = "480x360",
    view: View = None,
    azimuth: Azimuth = None,
    elevation: Elevation = None,
    mode: Mode = "clay",
    slice_t: Slice = None,
    settings: Set = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Draw the body while its numbers change, as a film.

    It is seen as the preset remembers it, unless a view is named, and from so far that it is whole in every frame.
    """
    started = perf_counter()
    extent = pixels(size)
    scene = scene_of(preset, slice_t, settings)
    from . import films  # late: a preset at fault is told at once

    checked([output], films.ENDINGS, [preset])
    moving = _moving(preset, scene, sweep, animation, turntable)
    if moving is not None:
        moving = moving.changed(easing=easing or moving.easing, repeat="ping-pong" if ping_pong else moving.repeat)
    count, duration = _timing(seconds, fps, frames, moving.duration if moving else _TURNED)
    films.writable(output, count, duration)
    drawable(mode)
    camera = looking(remembered(scene.view.get("camera")) or usual(scene.dimension), view, azimuth, elevation)
    turns = [360 * index / count if turntable else 0.0 for index in range(count)]
    moments = list(zip(moving.phases(count) if moving else [0.0] * count, turns, strict=True))
    with TemporaryDirectory(prefix="hqmodel-") as folder:
        with progress(quiet) as report:
            report(0.0, "Measuring")
            seen = _seen(preset, scene, camera, moving, list(dict.fromkeys(moments)), extent[0] / extent[1])
            drawn = _drawn(seen, extent, mode, Path(folder), report)
        number = {moment: index for index, moment in enumerate(drawn)}
        loops = turntable or moving is None or moving.repeat != "once"
        film = films.Film(list(drawn.values()), [number[moment] for moment in moments], duration, loops)
        files = films.write(film, output)
    result = {"frames": count, "duration": duration, "width": extent[0], "height": extent[1], "mode": mode}
    result |= {"files": list(map(str, files)), "seconds": perf_counter() - started}
    told = str(files[0]) if len(files) == 1 else f"{files[0]} to {files[-1].name}"
    tell(result, f"{told}: {count} frames, {duration:g} s, {extent[0]} x {extent[1]} pixels", as_json, quiet)


def _moving(preset: str, scene: Scene, sweeps: list[str] | None, name: str | None, turntable: bool) -> Animation | None:
    """What changes but for the turn of a turntable; None where that is all."""
    if sweeps and name is not None:
        raise Fault("--sweep: expected sweeps or --animation, got both", USAGE)
    if sweeps:
        return _swept(scene, sweeps)
    names = [tree.get("name") for tree in scene.animations]
    if name is None and turntable:
        return None
    if not names:
        raise Fault(f"{preset}: has no animation: say what changes with --sweep PATH=A:B, or --turntable", USAGE)
    if name is not None and name not in names:
        raise Fault(f"--animation: expected {' or '.join(map(shown, names))}, got {shown(name)}", USAGE)
    try:
        return animation_at(scene, names.index(name) if name is not None else 0)
    except EditError as error:
        raise Fault(f"{preset}: {error}", INPUT) from None


def _swept(scene: Scene, sweeps: list[str]) -> Animation:
    found = []
    for text in sweeps:
        try:
            found.append(sweep_of(scene, text))
        except EditError as error:
            raise Fault(f"--sweep: {error}", USAGE) from None
        if len(found[-1].values) != len(found[0].values):
            raise Fault(f"--sweep: expected {len(found[0].values)} values like the first sweep, got {shown(text)}", USAGE)
    return Animation(duration=_SWEPT, sweeps=tuple(found))


def _timing(seconds: float | None, fps: float | None, frames: int | None, usual_seconds: float) -> tuple[int, float]:
    """How many frames there are, and how many seconds they last."""
    if seconds is not None and fps is not None and frames is not None:
        raise Fault("--frames: expected two of --frames, --seconds and --fps, got all three", USAGE)
    for option, value in (("--seconds", seconds), ("--fps", fps)):
        if value is not None and not 0 < value <= 3600:
            raise Fault(f"{option}: expected a number above 0 and up to 3600, got {value:g}", USAGE)
    rate = fps or FPS
    count = frames if frames is not None else round((seconds or usual_seconds) * rate)
    if not 2 <= count <= _MOST:
        raise Fault(f"--frames: expected a number from 2 to {_MOST}, got {count}", USAGE)
    return count, seconds or (count / rate if frames is not None else usual_seconds)


def _seen(
    preset: str, scene: Scene, camera: Camera, moving: Animation | None, moments: list[Moment], aspect: float
) -> dict[Moment, tuple[Scene, Region, Camera]]:
    """The scene, its region and the camera at each moment: one target and one distance, from which all of all bodies is seen."""
    from hqmodel.field import region

    try:
        stages = {phase: staged(scene, moving, phase) if moving else scene for phase, _ in moments}
    except EditError as error:
        raise Fault(f"{preset}: {error}", INPUT) from None
    known = {id(stage): region(stage) for stage in {id(stage): stage for stage in stages.values()}.values()}
    regions = {phase: known[id(stage)] for phase, stage in stages.items()}
    boxes = [where for where in known.values() if not where.empty] or list(known.values())
    low = [min(where.low[axis] for where in boxes) for axis in range(3)]
    high = [max(where.high[axis] for where in boxes) for axis in range(3)]
    cameras = {}
    for phase, turn in moments:
        turned = filmed(camera, moving, phase) if moving else camera
        cameras[phase, turn] = replace(turned, azimuth=turned.azimuth + turn).framing(low, high, aspect)
    distance = max(camera.distance for camera in cameras.values())
    return {
        (phase, turn): (stages[phase], regions[phase], replace(camera, distance=distance))
        for (phase, turn), camera in cameras.items()
    }


def _drawn(
    seen: dict[Moment, tuple[Scene, Region, Camera]], size: tuple[int, int], mode: str, folder: Path, report: Report
) -> dict[Moment, Path]:
    """Each moment's picture as a file."""
    from PIL import Image

    from hqmodel import gpu

    files: dict[Moment, Path] = {}
    try:
        ctx = gpu.offscreen()
        for moment, (scene, where, camera) in seen.items():
            report(len(files) / len(seen), "Drawing")
            drawn = gpu.render(scene, camera, size, mode, samples=_SAMPLES, ctx=ctx, where=where)
            files[moment] = folder / f"{len(files)}.png"
            Image.fromarray(drawn[..., :3]).save(files[moment], compress_level=1)
        ctx.release()
    except gpu.GpuError as error:
        raise Fault(str(error), MACHINE) from None
    return files
