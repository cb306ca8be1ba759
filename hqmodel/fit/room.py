"""Whether a file's points will find room in memory, judged by its size and its first lines before it is read."""

from __future__ import annotations

import re
from pathlib import Path

from hqmodel import memory

from .cloud import FitError

# Bytes that reading and fitting want at the most: for a point, on a line of text too; for a line of a PLY file in letters; for
# a triangle, and for one in letters; for a line of an OBJ file; for each of the file's in any case; and for the rest. Measured
# for a million points and half a million triangles.
_POINT, _PLY_LINE, _FACE, _STL_LINES, _OBJ_LINE, _WHOLE, _REST = 110.0, 650.0, 700.0, 2100.0, 400.0, 2.0, 1e8
# As much of a file as is looked at; a PLY file's header is far shorter.
_HEAD = 1 << 16
_ELEMENT = re.compile(rb"^element\s+(vertex|face)\s+(\d{1,18})\s*$", re.MULTILINE)


def must_have_room(path: Path, suffix: str) -> None:
    """Raise FitError where there is no memory for what a file of that ending holds, with how much there is for; and OSError."""
    if not path.is_file():
        return  # what is no file says so itself, and a pipe is read once only
    size = path.stat().st_size
    with path.open("rb") as stream:
        rows, noun, wanted = _content(stream.read(_HEAD), size, suffix)
    wanted = max(wanted, _WHOLE * size)
    free, needed = memory.available(), _REST + wanted
    if needed > free and wanted > 0:
        raise FitError(
            f"expected at most {int(rows * max(0.0, free - _REST) / wanted):,} {noun} in the {memory.told(free)} of memory "
            f"that are free, got {'' if suffix == '.ply' else 'about '}{rows:,}, which need about {memory.told(needed)}"
        )


def _content(head: bytes, size: int, suffix: str) -> tuple[int, str, float]:
    """How many rows a file of that size that begins so has, what they are, and the bytes of memory that they want."""
    lines = size * max(1, head.count(b"\n")) // max(1, len(head))
    if suffix == ".ply":
        counts = {name: int(count) for name, count in _ELEMENT.findall(head)}
        points, faces = counts.get(b"vertex", 0), counts.get(b"face", 0)
        each = _PLY_LINE if b"format ascii" in head else _POINT
        return points + faces, "points and faces" if faces else "points", each * points + _FACE * faces
    if suffix == ".stl":
        in_letters = size != 84 + 50 * int.from_bytes(head[80:84], "little")
        triangles = lines // 7 if in_letters else size // 50
        return triangles, "triangles", (_STL_LINES if in_letters else _FACE) * triangles
    return (lines, "lines", _OBJ_LINE * lines) if suffix == ".obj" else (lines, "points", _POINT * lines)
