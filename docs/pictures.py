"""Makes the README's pictures with the program itself: ``make pictures`` (under Xvfb, for the window).

The starters by `hqmodel.render`, the window by photographing the real one at rest.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image, ImageGrab

import hqmodel
from hqmodel.edit import framed_scene

IMAGES = Path(__file__).parent / "images"
SHOWN = (
    ("cat", "brilliant", "owl", "goblet"),
    ("linked-rings", "pierced-dumbbell", "rocket", "head"),
    ("tetrahedral-slice", "teddy", "pawn", "butterfly"),
)
TILE = (320, 240)
SOLIDS = (
    ("tetrahedron", "octahedron", "cube", "icosahedron", "dodecahedron", "rhombic-dodecahedron"),
    ("truncated-tetrahedron", "truncated-octahedron", "truncated-cube", "truncated-icosahedron", "truncated-dodecahedron",
     "rhombic-triacontahedron"),
    ("cuboctahedron", "rhombicuboctahedron", "truncated-cuboctahedron", "icosidodecahedron", "rhombicosidodecahedron",
     "truncated-icosidodecahedron"),
)  # fmt: skip
IN_THE_WINDOW = "cat"
SHOT_MILLISECONDS = 600
REFINED_AFTER = 120.0  # seconds, for a software renderer


def sheet(rows: Sequence[Sequence[hqmodel.Scene]], tile: tuple[int, int]) -> Image.Image:
    """Scenes side by side, in rows of as many."""
    whole = Image.new("RGB", (tile[0] * len(rows[0]), tile[1] * len(rows)))
    for j, row in enumerate(rows):
        for i, scene in enumerate(row):
            whole.paste(Image.fromarray(hqmodel.render(scene, size=tile)).convert("RGB"), (tile[0] * i, tile[1] * j))
    return whole


def starters() -> Image.Image:
    """A sheet of starter presets."""
    return sheet([[hqmodel.load(name) for name in row] for row in SHOWN], TILE)


def solids() -> Image.Image:
    """The solids that `hqmodel new` makes."""
    return sheet([[framed_scene(name, 200.0) for name in row] for row in SOLIDS], (200, 160))


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


def sculpting() -> list[Image.Image]:
    """A sculpting session in the window, from the tests' own hands."""
    with TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "tests.app.drive", "tests.app.sculpting:session", folder]
        subprocess.run(command, check=True, cwd=IMAGES.parents[1])
        shots = [Image.open(path).convert("RGB") for path in sorted(Path(folder).glob("film-*.png"))]
    palette = shots[-1].quantize(192, Image.Quantize.MEDIANCUT)
    return [shot.quantize(palette=palette, dither=Image.Dither.NONE) for shot in shots]


def main() -> None:
    """Write the pictures."""
    IMAGES.mkdir(exist_ok=True)
    for name, make in (("starters", starters), ("solids", solids), ("window", window)):
        make().save(IMAGES / f"{name}.jpg", quality=90)
    first, *rest = sculpting()
    first.save(IMAGES / "sculpting.gif", save_all=True, append_images=rest, duration=SHOT_MILLISECONDS, loop=0)


if __name__ == "__main__":
    main()
