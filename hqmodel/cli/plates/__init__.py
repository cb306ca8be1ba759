"""The paper's figures as pictures: each figure's stages drawn side by side, and a page that holds them all."""

from .lettering import label
from .page import page
from .sheet import Panel, sheet
from .stages import panels

__all__ = ["Panel", "label", "page", "panels", "sheet"]
