"""The tools that the left button can be, and how they are set."""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import icons_fontawesome_6 as icons

from hqmodel import edit

from .sculpting import Way


@dataclass(frozen=True)
class Tool:
    """How a tool is called and looks, its key, and what its drag does, in a few words."""

    label: str
    icon: str
    key: str
    hint: str


TOOLS: dict[str, Tool] = {
    "faces": Tool("Faces", icons.ICON_FA_HAND_POINTER, "1", "Drag a face to push its plane; beside the body the view turns"),
    "pat": Tool("Pat", icons.ICON_FA_HAND, "2", "Press on the body and push: the clay gets flat there"),
    "chop": Tool("Chop", icons.ICON_FA_SCISSORS, "3", "Draw a line across the body to cut it with a plane"),
    "soften": Tool("Soften", icons.ICON_FA_DROPLET, "4", "Drag a face right to press it flatter, left to make it rounder"),
    "move": Tool("Move", icons.ICON_FA_UP_DOWN_LEFT_RIGHT, "5", "Drag the arrows to move what is selected"),
    "turn": Tool("Turn", icons.ICON_FA_ROTATE, "6", "Drag the rings to turn what is selected"),
    "scale": Tool("Scale", icons.ICON_FA_MAXIMIZE, "7", "Drag the handles to scale what is selected"),
    "box": Tool("Box select", icons.ICON_FA_VECTOR_SQUARE, "B", "Draw a box around the shapes to select"),
    "view": Tool("View", icons.ICON_FA_EYE, "8", "Drag to turn the view, with Shift to shift it"),
}
# Tools that take hold of the surface under the pointer.
TOUCHING = ("faces", "pat", "soften")


@dataclass(frozen=True)
class Kit:
    """The tool in hand and how it is set: which planes a push moves, and the exponents of planes patted and cut."""

    tool: str = "faces"
    way: Way = "one"
    pat: float = edit.PAT
    chop: float = edit.CHOP
