"""Frames to files: an animated GIF, numbered PNG files, or MP4 by an installed ffmpeg."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from hqmodel.files import atomic, filling

Report = Callable[[float, str], None]
# Told how many frames are done.
Told = Callable[[int], None]

# Colours of a GIF's palette: one place is left for what stays as it was in the frame before.
_COLORS = 255
# Frames that the palette is made of.
_SAMPLED = 16
# Viewers show what is meant to be faster than this slowly.
GIF_FASTEST = 50
# Seconds between two looks at whether somebody wants it stopped.
_ASKING = 0.1
_NO_FFMPEG = "expected ffmpeg to write it with, found none: install it (on Debian and Ubuntu: ffmpeg), or write .gif or .png"


class FilmError(Exception):
    """Such a film cannot be; one line that begins with its file."""


class NoWriter(FilmError):
    """The machine lacks what would write it, or that has failed."""


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


def check(path: Path, frames: int, seconds: float) -> None:
    """Raise FilmError, before anything is drawn, when such a film cannot be written."""
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        raise FilmError(f"{path}: expected a file name that ends in {' or '.join(ENDINGS)}, got {path.suffix or 'no ending'}")
    if ending == ".gif" and frames > GIF_FASTEST * seconds:
        got = f"{frames / seconds:g}"
        raise FilmError(f"{path}: expected at most {GIF_FASTEST} frames a second in a GIF, got {got}")
    if ending == ".mp4" and shutil.which("ffmpeg") is None:
        raise NoWriter(f"{path}: {_NO_FFMPEG}")


def write(film: Film, path: Path, report: Report) -> list[Path]:
    """Write the film as its ending says; the files that it made, all of them whole or none. Raises FilmError and OSError."""

    def told(frames: int) -> None:
        report(frames / len(film), "Writing")

    told(0)
    return _WRITERS[path.suffix.lower()](film, path, told)


def _gif(film: Film, path: Path, told: Told) -> list[Path]:
    """One palette for all frames, and no dithering: what is between its colours goes to the nearest, and nothing crawls."""
    palette = _palette(film, told)

    @cache
    def shown(index: int) -> Image.Image:
        return film.picture(index).quantize(palette=palette, dither=Image.Dither.NONE)

    def frame(number: int) -> Image.Image:
        told(number)
        return shown(film.order[number])

    rest = (frame(number) for number in range(1, len(film)))
    marks = [round(100 * film.seconds * index / len(film)) for index in range(len(film) + 1)]
    options: dict[str, Any] = {"loop": 0} if film.loops else {}
    delays = [10 * (end - start) for start, end in pairwise(marks)]
    with atomic(path) as stream:
        frame(0).save(stream, format="gif", save_all=True, append_images=rest, duration=delays, optimize=False, **options)
        told(len(film))
    return [path]


def _palette(film: Film, told: Told) -> Image.Image:
    """The colours that serve frames from all of the film best; the ground, though most of it, has no more than its share."""
    chosen = np.unique(np.linspace(0, len(film.pictures) - 1, _SAMPLED).round().astype(int))
    packed = []  # a number for each color: many times quicker to sort than rows
    for index in chosen:
        told(0)
        packed.append(np.asarray(film.picture(int(index)))[::2, ::2].reshape(-1, 3) @ np.array([1 << 16, 1 << 8, 1], np.uint32))
    numbers, counts = np.unique(np.concatenate(packed), return_counts=True)
    colors = np.stack([numbers >> 16, numbers >> 8 & 255, numbers & 255], axis=1).astype(np.uint8)
    shares = np.repeat(colors, np.ceil(np.sqrt(counts)).astype(int), axis=0)
    return Image.fromarray(shares[None]).quantize(_COLORS, method=Image.Quantize.MEDIANCUT, kmeans=1)


def _png(film: Film, path: Path, told: Told) -> list[Path]:
    names = numbered(path, len(film))
    with filling(path.parent) as folder:
        for done, (name, index) in enumerate(zip(names, film.order, strict=True)):
            shutil.copyfile(film.pictures[index], folder / name.name)
            told(done + 1)
    return names


def numbered(path: Path, frames: int) -> list[Path]:
    """The names of numbered files, from 1: for #### or %04d in the name, or after it as in name_0001.png."""
    stem = path.stem if re.search(r"#|%0?\d?d", path.stem) else f"{path.stem}_####"
    marked = re.sub(r"#+|%0?(\d?)d", lambda mark: f"\0{mark[1] or 1 if mark[0][0] == '%' else len(mark[0])}\0", stem, count=1)
    before, width, after = marked.split("\0")
    return [path.with_name(f"{before}{number:0{width}}{after}{path.suffix}") for number in range(1, frames + 1)]


def _mp4(film: Film, path: Path, told: Told) -> list[Path]:
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
        _fed(command, film, (width, height), path, told)
    return [path]


def _fed(command: list[str], film: Film, size: tuple[int, int], path: Path, told: Told) -> None:
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        try:
            _pour(film, size, process, told)
            said = _ended(process, lambda: told(len(film)))
        except BaseException:
            process.kill()
            raise
    if process.returncode:
        lines = said.decode(errors="replace").strip().splitlines() or ["no reason given"]
        raise NoWriter(f"{path}: ffmpeg could not write it: {lines[-1]}")


def _pour(film: Film, size: tuple[int, int], process: subprocess.Popen[bytes], told: Told) -> None:
    """Hand it the frames, their sides made even by repeating the last row and column."""
    assert process.stdin is not None
    with suppress(BrokenPipeError):  # it has ended, and says itself what is wrong
        for done, index in enumerate(film.order):
            told(done)
            pixels = np.asarray(film.picture(index))
            grown = [(0, size[1] - pixels.shape[0]), (0, size[0] - pixels.shape[1]), (0, 0)]
            process.stdin.write(np.pad(pixels, grown, mode="edge").tobytes())


def _ended(process: subprocess.Popen[bytes], ask: Callable[[], None]) -> bytes:
    """What it has said when it has ended; until then `ask` is asked, now and again, whether to go on."""
    while True:
        try:
            return process.communicate(timeout=_ASKING)[1]
        except subprocess.TimeoutExpired:
            ask()


_WRITERS: dict[str, Callable[[Film, Path, Told], list[Path]]] = {".gif": _gif, ".png": _png, ".mp4": _mp4}
ENDINGS = tuple(_WRITERS)
