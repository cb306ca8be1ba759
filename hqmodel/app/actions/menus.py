"""The menu bar: which action is where."""

from __future__ import annotations

from hqmodel import edit
from hqmodel.model import VIEWS

from ..preferences import SIZES, STEPS, THEMES
from ..tools.arranging import AXES
from ..tools.kit import TOOLS
from ..tools.reach import MODAL
from ..view import MODES
from .clay import AROUND, PRISMS
from .looks import PANELS

Entry = str | None | tuple[str, tuple[str, ...]]
RECENT = "recent"

# Names of actions, None for a line between, a pair for a menu within; RECENT stands for the recent files.
MENUS: dict[str, tuple[Entry, ...]] = {
    "File": (
        "new",
        "open",
        RECENT,
        None,
        "save",
        "save as",
        "versions",
        None,
        "import",
        "export",
        "film",
        "stop export",
        None,
        "quit",
    ),
    "Edit": ("undo", "redo", None, "select all", "select none", None, "duplicate", "delete", "move up", "move down"),
    "Add": (*(f"add {kind}" for kind in edit.PRIMITIVES), *(f"add prism {n}" for n in PRISMS), None, "add strip"),
    "Shape": (
        *(f"hold {name}" for name in MODAL),
        None,
        "rounder",
        "sharper",
        "pinch",
        None,
        "carve",
        "solo",
        ("Copies Around z", tuple(f"around {n}" for n in AROUND)),
    ),
    "Tools": tuple(f"tool {name}" for name in TOOLS),
    "View": (
        *(f"mode {mode}" for mode in MODES),
        None,
        ("Section", tuple(f"section {axis}" for axis in AXES)),
        ("Grid", ("grid", "grid auto", *(f"grid {step:g}" for step in STEPS))),
        "ghosts",
        "bands",
        "cloud",
        "refine",
        "frame time",
        None,
        "frame all",
        "frame selected",
        ("Look From", tuple(f"view {name}" for name in VIEWS)),
        "orthographic",
        None,
        ("Panels", (*(f"panel {name}" for name in PANELS), "reset layout")),
        ("Theme", tuple(f"theme {name}" for name in THEMES)),
        ("Size", tuple(f"size {percent}" for percent in SIZES)),
    ),
    "Help": ("palette", "shortcuts", "tour", None, "about"),
}
