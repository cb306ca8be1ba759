"""hqmodel: a modeller for hyperquadrics (Hanson 1988). The names here are the public API for scripts.

Importing the package loads none of it: each name comes with its first use, and OpenGL only with `render`.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .files import load, save
    from .fit import fit
    from .gpu import render
    from .mesh import polygonize
    from .model import Scene, Shape, Strip

__version__ = "0.1.0"

__all__ = ["Scene", "Shape", "Strip", "fit", "load", "polygonize", "render", "save"]

_HOMES = {
    "load": "files",
    "save": "files",
    "Scene": "model",
    "Shape": "model",
    "Strip": "model",
    "fit": "fit",
    "polygonize": "mesh",
    "render": "gpu",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'hqmodel' has no attribute {name!r}")
    value = globals()[name] = getattr(import_module(f".{_HOMES[name]}", __name__), name)
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
