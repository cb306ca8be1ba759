"""hqmodel animate: a sweep of any numbers, or a turn about the body, as a film."""

from __future__ import annotations

from pathlib import Path
from time import perf_counter
from typing import Annotated, Literal

import typer

from hqmodel.edit import Animation, EditError, animation_at, sweep_of
from hqmodel.edit.animation import FPS, MOST_FRAMES
from hqmodel.model import Scene, remembered, shown, usual

from .faults import INPUT, MACHINE, USAGE, Fault, unwritable
from .options import Json, Preset, Quiet, Set, Slice, scene_of
from .outputs import checked, tell
from .progress import progress
from .views import Azimuth, Elevation, Mode, Size, View, drawable, looking, pixels

# The seconds of what has no duration of its own.
_SWEPT, _TURNED = 4.0, 6.0

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
    from hqmodel import film, gpu  # late: a preset at fault is told at once

    checked([output], film.ENDINGS, [preset])
    moving = _moving(preset, scene, sweep, animation, turntable)
    if moving is not None:
        moving = moving.changed(easing=easing or moving.easing, repeat="ping-pong" if ping_pong else moving.repeat)
    count, duration = _timing(seconds, fps, frames, moving.duration if moving else _TURNED)
    drawable(mode)
    camera = looking(remembered(scene.view.get("camera")) or usual(scene.dimension), view, azimuth, elevation)
    plan = film.Plan(scene, camera, moving, turntable, count, duration, extent, mode)
    try:
        film.check(output, count, duration)
        with progress(quiet) as report:
            files = film.shoot(plan, output, report)
    except EditError as error:
        raise Fault(f"{preset}: {error}", INPUT) from None
    except (film.NoWriter, gpu.GpuError) as error:
        raise Fault(str(error), MACHINE) from None
    except film.FilmError as error:
        raise Fault(str(error), USAGE) from None
    except OSError as error:
        raise unwritable(error.filename or output, error) from None
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
    if not 2 <= count <= MOST_FRAMES:
        raise Fault(f"--frames: expected a number from 2 to {MOST_FRAMES}, got {count}", USAGE)
    return count, seconds or (count / rate if frames is not None else usual_seconds)
