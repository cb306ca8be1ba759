"""Frames to files: an animated GIF, numbered PNG files, or MP4 by an installed ffmpeg."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from .faults import MACHINE, USAGE, Fault
from .outputs import filling, writing

Picture = NDArray[np.uint8]

# Colours of a GIF's palette: one place is left for what stays as it was in the frame before.
_COLORS = 255
# Frames that the palette is made of.
_SAMPLED = 16
# Viewers show what is meant to be faster than this slowly.
GIF_FASTEST = 50
_NO_FFMPEG = "expected ffmpeg to write it with, found none: install it (on Debian and Ubuntu: ffmpeg), or write .gif or .png"


@dataclass(frozen=True)
class Film:
    """Pictures drawn once each, as PNG files, and in which order they are shown in so many seconds."""

    pictures: Sequence[Path]
    order: Sequence[int]
    seconds: float
    loops: bool

    def __len__(self) -> int:
        return len(self.order)

    def picture(self, index: int) -> Image.Image:
        with Image.open(self.pictures[index]) as image:
            return image.convert("RGB")


def writable(path: Path, frames: int, seconds: float) -> None:
    """Raise Fault, before anything is drawn, when such a film cannot be written."""
    ending = path.suffix.lower()
    if ending == ".gif" and frames > GIF_FASTEST * seconds:
        got = f"{frames / seconds:g}"
        raise Fault(f"{path}: expected at most {GIF_FASTEST} frames a second in a GIF, got {got}", USAGE)
    if ending == ".mp4" and shutil.which("ffmpeg") is None:
        raise Fault(f"{path}: {_NO_FFMPEG}", MACHINE)


def write(film: Film, path: Path) -> list[Path]:
    """Write the film as its ending says; the files that it made. Raises Fault."""
    return _WRITERS[path.suffix.lower()](film, path)


def _gif(film: Film, path: Path) -> list[Path]:
    """One palette for all frames, and no dithering: what is between its colours goes to the nearest, and nothing crawls."""
    palette = _palette(film)
    shown = [film.picture(index).quantize(palette=palette, dither=Image.Dither.NONE) for index in range(len(film.pictures))]
    first, *rest = (shown[index] for index in film.order)
    marks = [round(100 * film.seconds * index / len(film)) for index in range(len(film) + 1)]
    options: dict[str, Any] = {"loop": 0} if film.loops else {}
    delays = [10 * (end - start) for start, end in pairwise(marks)]
    with writing([path]) as (stream,):
        first.save(stream, format="gif", save_all=True, append_images=rest, duration=delays, optimize=False, **options)
    return [path]


def _palette(film: Film) -> Image.Image:
    """The colours that serve frames from all of the film best; the ground, though most of it, has no more than its share."""
    chosen = np.unique(np.linspace(0, len(film.pictures) - 1, _SAMPLED).round().astype(int))
    pixels = np.concatenate([np.asarray(film.picture(int(index)))[::2, ::2].reshape(-1, 3) for index in chosen])
    colors, counts = np.unique(pixels, axis=0, return_counts=True)
    shares = np.repeat(colors, np.ceil(np.sqrt(counts)).astype(int), axis=0)
    return Image.fromarray(shares[None]).quantize(_COLORS, method=Image.Quantize.MEDIANCUT, kmeans=1)


def _png(film: Film, path: Path) -> list[Path]:
    names = numbered(path, len(film))
    with filling(path.parent) as folder:
        for name, index in zip(names, film.order, strict=True):
            shutil.copyfile(film.pictures[index], folder / name.name)
    return names


def numbered(path: Path, frames: int) -> list[Path]:
    """The names of numbered files, from 1: for #### or %04d in the name, or after it as in name_0001.png."""
    stem = path.stem if re.search(r"#|%0?\d?d", path.stem) else f"{path.stem}_####"
    marked = re.sub(r"#+|%0?(\d?)d", lambda mark: f"\0{mark[1] or 1 if mark[0][0] == '%' else len(mark[0])}\0", stem, count=1)
    before, width, after = marked.split("\0")
    return [path.with_name(f"{before}{number:0{width}}{after}{path.suffix}") for number in range(1, frames + 1)]


def _mp4(film: Film, path: Path) -> list[Path]:
    """H.264 that every player shows: 4:2:0, sides even, and the index before the pictures."""
    width, height = (side + side % 2 for side in film.picture(0).size)
    with filling(path.parent) as folder:
        command = ["ffmpeg", "-v", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}"]
        command += [
            "-r",
            f"{len(film)}/{film.seconds:g}" if film.seconds.is_integer() else f"{len(film) / film.seconds:.6f}",
            "-i",
            "-",
        ]
        command += ["-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart"]
        command += ["-fflags", "+bitexact", "-flags:v", "+bitexact", str(folder / path.name)]
        _fed(command, film, (width, height), path)
    return [path]


def _fed(command: list[str], film: Film, size: tuple[int, int], path: Path) -> None:
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        assert process.stdin is not None
        try:
            for index in film.order:
                pixels = np.asarray(film.picture(index))
                grown = [(0, size[1] - pixels.shape[0]), (0, size[0] - pixels.shape[1]), (0, 0)]
                process.stdin.write(np.pad(pixels, grown, mode="edge").tobytes())
        except BrokenPipeError:
            pass  # it has ended, and says below what is wrong
        except BaseException:
            process.kill()
            raise
        _, said = process.communicate()
    if process.returncode:
        lines = said.decode(errors="replace").strip().splitlines() or ["no reason given"]
        raise Fault(f"{path}: ffmpeg could not write it: {lines[-1]}", MACHINE)


_WRITERS: dict[str, Callable[[Film, Path], list[Path]]] = {".gif": _gif, ".png": _png, ".mp4": _mp4}
ENDINGS = tuple(_WRITERS)
