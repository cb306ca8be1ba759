"""Meshes as files: the text ones, OBJ and 3MF, are here.

Files are written in small blocks, so that whoever has them written can stop that at any of them. A million triangles in OBJ:
0.5 s by joined formatting against 1.6 s (trimesh) and 2.9 s (meshio), measured side by side.
"""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from math import floor, log10
from typing import Any, BinaryIO
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from . import binary
from .mesh import Array, Mesh, MeshError
from .placing import FORMATS, SIZES

_ROWS = 1 << 13
# Text files keep positions to this many digits of the longest side, wherever the body lies.
_DIGITS = 9
# Binary ones keep float32: near the origin far more than enough, far from it at last too coarse for the body's own size.
_FLOAT32 = frozenset({".ply", ".stl", ".glb"})
_FAR = 10.0
# How far off, as a share of the longest side, a vertex may come to lie by that.
_OFF = 1e-4


def write(mesh: Mesh, stream: BinaryIO, suffix: str, name: str = "hqmodel") -> None:
    """Write the mesh, already `fitted` to the format, to a binary stream. The same mesh gives the same bytes.

    Normals and colours go with it where it has them and the format knows them. Raises MeshError for an unknown ending, and for
    a mesh so large, so small or so far off that the format cannot hold it.
    """
    writers: dict[str, Callable[[Mesh, BinaryIO, str], None]] = {
        ".obj": _obj,
        ".ply": binary.ply,
        ".stl": binary.stl,
        ".glb": binary.glb,
        ".3mf": _3mf,
    }
    if suffix not in writers:
        raise MeshError(f"expected a file name ending in one of {', '.join(FORMATS)}, got {suffix or 'none'!r}")
    _must_fit(mesh, suffix)
    writers[suffix](mesh, stream, " ".join(name.split()) or "hqmodel")


def _must_fit(mesh: Mesh, suffix: str) -> None:
    """Raise MeshError for what the file's digits would make another body of."""
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    side, away = float(np.max(high - low)), float(np.max(np.abs([low, high])))
    if not SIZES[0] <= side <= SIZES[1]:
        raise MeshError(f"size: expected a longest side from {SIZES[0]:g} to {SIZES[1]:g}, got {side:g}")
    if suffix in _FLOAT32 and away > _FAR * side:
        corners = mesh.vertices.astype(np.float32)[mesh.faces]
        coarse = np.spacing(np.float32(away)) > _OFF * side
        if coarse or any(np.any(np.all(corners[:, i] == corners[:, i - 1], axis=1)) for i in range(3)):
            where = f"a body {side:.3g} long at a distance of {away:.3g}"
            raise MeshError(f"expected a body nearer to the origin, as {suffix} keeps 7 digits (.obj keeps more), got {where}")


def _obj(mesh: Mesh, stream: BinaryIO, name: str) -> None:
    """Colours as the usual extension of ``v``: sRGB in 0..1 after the position; quads with ``vt`` where the mesh has them."""
    stream.write(f"# hqmodel\no {name.replace(' ', '_')}\n".encode())
    point = _fixed(mesh.vertices)
    if mesh.colors is None:
        _lines(stream, f"v {point} {point} {point}\n", mesh.vertices)
    else:
        colors = np.round(mesh.colors / 255, 4)
        _lines(stream, f"v {point} {point} {point} %.4g %.4g %.4g\n", np.column_stack([mesh.vertices, colors]))
    if mesh.normals is not None:
        _lines(stream, "vn %.4f %.4f %.4f\n", mesh.normals)
    faces, uv = mesh.faces, None
    if mesh.quads is not None:
        faces, uv = mesh.quads.corners, mesh.quads.uv_corners
        _lines(stream, "vt %.6f %.6f\n", mesh.quads.uv)
    corners = [indices for indices in (faces, uv, None if mesh.normals is None else faces) if indices is not None]
    corner = f" %d{'' if uv is None else '/%d'}" if mesh.normals is None else f" %d/{'' if uv is None else '%d'}/%d"
    _lines(stream, f"f{corner * faces.shape[1]}\n", np.stack(corners, axis=2).reshape(len(faces), -1) + 1)


_TYPES = """<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
"""
_RELATIONS = """<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Id="rel0" Target="/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
"""
_MODEL = """<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
 xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02">
<resources>
"""
_END = """</triangles></mesh></object>
</resources>
<build><item objectid="1"/></build>
</model>
"""


def _3mf(mesh: Mesh, stream: BinaryIO, name: str) -> None:
    """Millimetres, z up; colours as a colour group of the materials extension, one entry for each colour that occurs."""
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=6) as package:
        for path, text in (("[Content_Types].xml", _TYPES), ("_rels/.rels", _RELATIONS)):
            package.writestr(_member(path), text)
        with package.open(_member("3D/3dmodel.model"), "w", force_zip64=True) as model:
            _3mf_model(mesh, model, name)


def _3mf_model(mesh: Mesh, model: Any, name: str) -> None:
    model.write(_MODEL.encode())
    corners: Any = mesh.faces
    triangle = '<triangle v1="%d" v2="%d" v3="%d"/>\n'
    if mesh.colors is not None:
        palette, entry = _palette(mesh.colors)
        model.write(b'<m:colorgroup id="2">\n')
        _lines(model, '<m:color color="#%02X%02X%02X"/>\n', palette)
        model.write(b"</m:colorgroup>\n")
        corners = np.column_stack([mesh.faces, entry[mesh.faces]])
        triangle = '<triangle v1="%d" v2="%d" v3="%d" pid="2" p1="%d" p2="%d" p3="%d"/>\n'
    model.write(f'<object id="1" type="model" name={quoteattr(name)}><mesh><vertices>\n'.encode())
    point = _fixed(mesh.vertices)
    _lines(model, f'<vertex x="{point}" y="{point}" z="{point}"/>\n', mesh.vertices)
    model.write(b"</vertices><triangles>\n")
    _lines(model, triangle, corners)
    model.write(_END.encode())


def _palette(colors: NDArray[np.uint8]) -> tuple[NDArray[np.int32], NDArray[np.intp]]:
    """The colours that occur, (n, 3) in order, and the number of each row of `colors` (V, 3) among them, (V,)."""
    red, green, blue = colors.astype(np.int32).T
    found, entry = np.unique(red << 16 | green << 8 | blue, return_inverse=True)
    return np.stack([found >> 16, found >> 8 & 255, found & 255], axis=1), entry


def _member(path: str) -> zipfile.ZipInfo:
    """An entry without the hour it was made at."""
    entry = zipfile.ZipInfo(path, date_time=(1980, 1, 1, 0, 0, 0))
    entry.compress_type = zipfile.ZIP_DEFLATED
    return entry


def _fixed(vertices: Array) -> str:
    """A number format that keeps positions to `_DIGITS` digits of the longest side."""
    size = float(np.max(np.ptp(vertices, axis=0)))
    return f"%.{min(max(_DIGITS - 1 - floor(log10(size)), 0), 60)}f"


def _lines(stream: Any, line: str, rows: Any) -> None:
    """One formatted line for each row, thousands at a time."""
    for start in range(0, len(rows), _ROWS):
        block = rows[start : start + _ROWS]
        stream.write((line * len(block) % tuple(block.ravel().tolist())).encode())
