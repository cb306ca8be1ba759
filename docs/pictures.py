"""Makes the README's pictures with the program itself: ``make pictures`` (under Xvfb, for the window).

The starters by `hqmodel.render`, the window by photographing the real one at rest.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

from PIL import Image, ImageGrab

import hqmodel

IMAGES = Path(__file__).parent / "images"
SHOWN = (
    ("cat", "brilliant", "owl", "goblet"),
    ("linked-rings", "pierced-dumbbell", "rocket", "head"),
    ("tetrahedral-slice", "teddy", "pawn", "butterfly"),
)
TILE = (320, 240)
IN_THE_WINDOW = "cat"
REFINED_AFTER = 120.0  # seconds, for a software renderer


def starters() -> Image.Image:
    """A sheet of starter presets."""
    sheet = Image.new("RGB", (TILE[0] * len(SHOWN[0]), TILE[1] * len(SHOWN)))
    for j, row in enumerate(SHOWN):
        for i, name in enumerate(row):
            tile = Image.fromarray(hqmodel.render(hqmodel.load(name), size=TILE)).convert("RGB")
            sheet.paste(tile, (TILE[0] * i, TILE[1] * j))
    return sheet


def window() -> Image.Image:
    """The modeller's window once its picture has had time to refine."""
    modeller = subprocess.Popen([sys.executable, "-m", "hqmodel", IN_THE_WINDOW])
    try:
        time.sleep(REFINED_AFTER)
        shot = ImageGrab.grab(xdisplay=os.environ["DISPLAY"]).convert("RGB")
        return shot.crop(shot.getbbox())
    finally:
        modeller.terminate()
        modeller.wait()


def main() -> None:
    """Write both pictures."""
    IMAGES.mkdir(exist_ok=True)
    for name, make in (("starters", starters), ("window", window)):
        make().save(IMAGES / f"{name}.jpg", quality=90)


if __name__ == "__main__":
    main()
