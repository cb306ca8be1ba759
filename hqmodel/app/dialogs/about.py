"""What the program is."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version

from imgui_bundle import imgui

from ..asks import Dialog
from ..intents import Answer, Intent
from .buttons import buttons


def draw(_: Dialog) -> list[Intent]:
    imgui.text_unformatted(f"hqmodel {_version()}")
    imgui.text_unformatted("Shapes hyperquadrics like clay.")
    imgui.spacing()
    imgui.text_disabled("A. J. Hanson, Hyperquadrics: Smoothly Deformable Shapes with Convex Polyhedral Bounds,")
    imgui.text_disabled("Computer Vision, Graphics, and Image Processing 44, 191-210 (1988).")
    imgui.spacing()
    imgui.text_disabled("Free software under the MIT license.")
    return [Answer()] if buttons(["Close"]) else []


def _version() -> str:
    try:
        return version("hqmodel")
    except PackageNotFoundError:  # run from a checkout that is not installed
        return "(not installed)"
