"""Binary mesh files, PLY, STL and GLB: little-endian, and written some thousand rows at a time."""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from typing import Any, BinaryIO, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import srgb_to_linear

from .mesh import Mesh, crosses, unit

_ROWS = 1 << 15
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_FACE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
# What PLY calls numbers, and the columns of a vertex.
_PLY_TYPES = {"<f4": "float", "u1": "uchar"}
_PLY_NAMES = {"vertices": ("x", "y", "z"), "normals": ("nx", "ny", "nz"), "colors": ("red", "green", "blue")}
# What glTF calls numbers, and buffers of corners and of vertices.
_GLTF_TYPES = {"<f4": 5126, "<u4": 5125, "u1": 5121}
_GLTF_CORNERS, _GLTF_VERTICES = 34963, 34962


def ply(mesh: Mesh, stream: BinaryIO, name: str) -> None:
    """Colours as uchar sRGB."""
    columns: dict[str, tuple[Any, str]] = {
        "vertices": (mesh.vertices, "<f4"),
        "normals": (mesh.normals, "<f4"),
        "colors": (mesh.colors, "u1"),
    }
    columns = {column: (rows, kind) for column, (rows, kind) in columns.items() if rows is not None}
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(mesh.vertices)}"]
    head += [f"property {_PLY_TYPES[kind]} {part}" for column, (_, kind) in columns.items() for part in _PLY_NAMES[column]]
    head += [f"element face {len(mesh.faces)}", "property list uchar int vertex_indices", "end_header", ""]
    stream.write("\n".join(head).encode())
    vertex = np.dtype([(column, kind, 3) for column, (_, kind) in columns.items()])
    _records(stream, vertex, {column: rows for column, (rows, _) in columns.items()})
    _records(stream, _FACE, {"count": np.full(len(mesh.faces), 3, dtype=np.uint8), "corners": mesh.faces})


def stl(mesh: Mesh, stream: BinaryIO, name: str) -> None:
    """Facets, each with its normal and its own corners."""
    stream.write(struct.pack("<80sI", b"hqmodel", len(mesh.faces)))
    for start in range(0, len(mesh.faces), _ROWS):
        corners = mesh.vertices[mesh.faces[start : start + _ROWS]]
        a, b, c = (corners[:, i] for i in range(3))
        _records(stream, _FACET, {"normal": unit(crosses(b - a, c - a)), "corners": corners})


class _Part(NamedTuple):
    """A part of a glTF mesh: its name and its rows there, its type of numbers, and what one row or number is."""

    name: str
    rows: NDArray[Any]
    kind: str
    element: str


def glb(mesh: Mesh, stream: BinaryIO, name: str) -> None:
    """Vertex colours are linear light in glTF, and opaque ones have four bytes."""
    parts = [_Part("indices", mesh.faces, "<u4", "SCALAR"), _Part("POSITION", mesh.vertices, "<f4", "VEC3")]
    if mesh.normals is not None:
        parts.append(_Part("NORMAL", mesh.normals, "<f4", "VEC3"))
    if mesh.colors is not None:
        linear = np.rint(srgb_to_linear(np.arange(256) / 255) * 255).astype(np.uint8)[mesh.colors]
        parts.append(_Part("COLOR_0", np.insert(linear, 3, 255, axis=1), "u1", "VEC4"))
    size = sum(_bytes(part) for part in parts)
    text = json.dumps(_gltf(parts, name, size), separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    stream.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + size))
    stream.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", size, b"BIN\0"))
    for part in parts:
        _records(stream, np.dtype([(part.name, part.kind, part.rows.shape[1])]), {part.name: part.rows})


def _gltf(parts: list[_Part], name: str, size: int) -> dict[str, Any]:
    """glTF's tree of a file with one mesh of these parts, one after the other in a buffer of that size."""
    views: list[dict[str, Any]] = []
    accessors: list[dict[str, Any]] = []
    for number, part in enumerate(parts):
        start = sum(_bytes(earlier) for earlier in parts[:number])
        target = _GLTF_CORNERS if part.element == "SCALAR" else _GLTF_VERTICES
        views.append({"buffer": 0, "byteOffset": start, "byteLength": _bytes(part), "target": target})
        count = part.rows.size if part.element == "SCALAR" else len(part.rows)
        accessors.append(
            {"bufferView": number, "componentType": _GLTF_TYPES[part.kind], "count": count, "type": part.element}
            | ({"normalized": True} if part.kind == "u1" else {})
        )
    positions = parts[1].rows
    accessors[1] |= {end: getattr(positions, end)(axis=0).astype(np.float32).tolist() for end in ("min", "max")}
    attributes = {part.name: number for number, part in enumerate(parts) if number}
    return {
        "asset": {"version": "2.0", "generator": "hqmodel"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": name, "mesh": 0}],
        "meshes": [{"name": name, "primitives": [{"attributes": attributes, "indices": 0}]}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": size}],
    }


def _bytes(part: _Part) -> int:
    return part.rows.size * np.dtype(part.kind).itemsize


def _records(stream: BinaryIO, layout: np.dtype[Any], columns: Mapping[str, NDArray[Any]]) -> None:
    """Rows of this layout from columns (n, ...), some thousand at a time; what is in no column is zero."""
    count = len(next(iter(columns.values())))
    for start in range(0, count, _ROWS):
        rows = np.zeros(min(_ROWS, count - start), layout)
        for name, column in columns.items():
            rows[name] = column[start : start + _ROWS]
        stream.write(rows.tobytes())
