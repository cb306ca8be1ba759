"""Clouds and meshes from files: points, and normals where the file tells them."""

from __future__ import annotations

import io
from itertools import islice, takewhile
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from .bodies import Array
from .cloud import FitError
from .room import must_have_room

FORMATS = (".ply", ".obj", ".stl", ".xyz")
# Points that a mesh's surface is sampled by.
SAMPLES = 30_000
_BLOCK = 1 << 16
_SHOWN = 40
# Lines of a PLY file that its header is looked for in.
_HEAD = 200


class Read(NamedTuple):
    """Points (N, 3), and their outward normals (N, 3) where they are known."""

    points: Array
    normals: Array | None


def read(path: Path, seed: int = 0) -> Read:
    """The cloud in a file: .xyz, .ply, .obj or .stl. Of a mesh the surface, sampled evenly.

    Raises FitError that says where in the file what is wrong, or how much of it would find room in memory, and OSError.
    """
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        raise FitError(f"expected a file name that ends in {', '.join(FORMATS)}, got {path.suffix or 'no ending'}")
    must_have_room(path, suffix)
    return _text(path) if suffix == ".xyz" else _mesh(path, suffix, np.random.default_rng(seed))


def sampled(vertices: Array, faces: Array, count: int, rng: np.random.Generator) -> Read:
    """Points (count, 3) of a mesh's triangles (F, 3), evenly by area, and the triangles' normals."""
    corners = vertices[faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(across, axis=1)
    total = float(area.sum())
    if not 0 < total < np.inf:
        raise FitError(f"faces: expected triangles that have an area, got {len(faces)} of area {total:g}")
    chosen = rng.choice(len(faces), count, p=area / total)
    points = np.einsum("nk,nki->ni", rng.dirichlet(np.ones(3), count), corners[chosen])
    return Read(points, across[chosen] / area[chosen, None])


def _mesh(path: Path, suffix: str, rng: np.random.Generator) -> Read:
    import trimesh  # late: it takes its time

    if suffix == ".ply" and path.is_file():  # a pipe is read once only
        _must_be_whole(path)
    try:
        with path.open("rb") as stream:
            loaded: Any = trimesh.load(stream, file_type=suffix[1:], force=None, process=False)
            if isinstance(loaded, trimesh.Scene):
                loaded = loaded.to_mesh()
    except OSError:
        raise
    except Exception as error:  # whatever a damaged file makes of the reader
        raise FitError(
            f"expected a file of the format {suffix[1:].upper()}, got one that can't be read: {_line(error)}"
        ) from None
    vertices = np.asarray(getattr(loaded, "vertices", np.empty((0, 3))), dtype=float)
    wrong = np.flatnonzero(~np.isfinite(vertices).all(axis=1))
    if len(wrong):
        raise FitError(f"vertex {wrong[0]}: expected finite numbers, got {vertices[wrong[0]].tolist()}")
    faces = np.asarray(getattr(loaded, "faces", ()))
    if not len(faces):
        return Read(vertices, _stored_normals(loaded))
    wrong = np.flatnonzero(((faces < 0) | (faces >= len(vertices))).any(axis=1))
    if len(wrong):
        raise FitError(f"face {wrong[0]}: expected vertices from 0 to {len(vertices) - 1}, got {faces[wrong[0]].tolist()}")
    loaded.merge_vertices(merge_norm=True, merge_tex=True)
    surface = sampled(np.asarray(loaded.vertices), np.asarray(loaded.faces), SAMPLES, rng)
    if not loaded.is_winding_consistent:
        return Read(surface.points, None)
    assert surface.normals is not None
    return Read(surface.points, surface.normals if loaded.volume >= 0 else -surface.normals)


def _must_be_whole(path: Path) -> None:
    """Raise FitError where a PLY file in letters has fewer or more lines than its header says; of others the reader knows."""
    with path.open("rb") as stream:
        lines = (line.split() for line in islice(stream, _HEAD))
        head = list(takewhile(lambda words: words != [b"end_header"], lines))
        if len(head) == _HEAD or [b"format", b"ascii"] not in [words[:2] for words in head]:
            return
        counts = [words[2] for words in head if words[:1] == [b"element"] and len(words) == 3]
        told = sum(int(count) for count in counts if count.isdigit())
        found = sum(1 for line in stream if line.strip())
    if found != told:
        raise FitError(f"header: expected {told:,} lines after it, one for each thing it names, got {found:,}")


def _stored_normals(cloud: Any) -> Array | None:
    """The normals of a PLY file's points."""
    try:
        data = cloud.metadata["_ply_raw"]["vertex"]["data"]
        return np.column_stack([np.asarray(data[name], dtype=float) for name in ("nx", "ny", "nz")])
    except (KeyError, ValueError, IndexError):
        return None


def _text(path: Path) -> Read:
    """Lines of x y z or x y z nx ny nz, parted by blanks or commas; # begins a comment."""
    blocks: list[Array] = []
    with path.open("rb") as raw:
        lines = io.TextIOWrapper(raw, encoding="utf-8-sig", errors="replace")
        done = 0
        while block := list(islice(lines, _BLOCK)):
            table = _numbers(block, done)
            if len(table):
                if blocks and table.shape[1] != blocks[0].shape[1]:
                    raise FitError(f"line {done + 1}: expected {blocks[0].shape[1]} numbers, got {table.shape[1]}")
                blocks.append(table)
            done += len(block)
    if not blocks:
        raise FitError("line 1: expected lines of x y z, got none")
    table = np.concatenate(blocks)
    return Read(table[:, :3], table[:, 3:] if table.shape[1] == 6 else None)


def _numbers(block: list[str], done: int) -> Array:
    """The numbers in some lines, all at once; where that fails, line by line to find out why."""
    try:
        filled = [line for line in (text.partition("#")[0].replace(",", " ") for text in block) if not line.isspace() and line]
        table = np.loadtxt(filled, ndmin=2) if filled else np.empty((0, 3))
        if not len(table) or (table.shape[1] in (3, 6) and np.isfinite(table).all()):
            return table
    except ValueError:
        pass
    raise FitError(_fault(block, done))


def _fault(block: list[str], done: int) -> str:
    """What is wrong with the first wrong line."""
    width = 0
    for number, text in enumerate(block, done + 1):
        cells = text.partition("#")[0].replace(",", " ").split()
        if not cells:
            continue
        if len(cells) not in (3, 6) or (width and len(cells) != width):
            return f"line {number}: expected {width or '3 or 6'} numbers, got {len(cells)}"
        width = len(cells)
        for cell in cells:
            if not _is_number(cell):
                return f"line {number}: expected finite numbers, got {cell[:_SHOWN]!r}"
    return f"line {done + 1}: expected lines of 3 or 6 finite numbers, got something else"


def _is_number(cell: str) -> bool:
    try:
        return bool(np.isfinite(float(cell)))
    except ValueError:
        return False


def _line(error: Exception) -> str:
    return " ".join((str(error) or type(error).__name__).split())[:120]
