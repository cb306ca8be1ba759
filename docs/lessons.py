"""Makes the pictures of the tutorial and of the model's page from their own Python blocks: ``python -m docs.lessons``.

A page's blocks run in order and share their names. A picture shows the `scenes` that the block before it made, side by side, or
else the `scene` as it stands there.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from PIL import Image

import hqmodel
from hqmodel.field import region
from hqmodel.model import Camera

FOLDER = Path(__file__).parent
PAGES = ("tutorial.md", "model.md")
_PART = re.compile(r"^```python\n(?P<code>.*?)^```$|^!\[[^]]*\]\((?P<picture>[^)]+)\)$", re.MULTILINE | re.DOTALL)
# The size of a picture of one scene, and of each of several.
_ONE, _SEVERAL = (360, 300), (220, 190)
_CAMERA = Camera(azimuth=32.0, elevation=12.0)
_TOP = Camera(orthographic=True).looking("top")


def run(page: Path, draw: Callable[[str, dict[str, Any]], None]) -> int:
    """Run a page's blocks; `draw` is given each picture's link and the names as they stand there. The number of blocks."""
    names: dict[str, Any] = {"__name__": page.stem}
    count = 0
    text = page.read_text(encoding="utf-8")
    for part in _PART.finditer(text):
        if part["picture"]:
            draw(part["picture"], names)
            names.pop("scenes", None)
        else:
            line = text.count("\n", 0, part.start()) + 1
            exec(compile("\n" * line + part["code"], str(page), "exec"), names)
            count += 1
    return count


def _draw(link: str, names: dict[str, Any]) -> None:
    scenes = names.get("scenes", [names.get("scene")])
    width, height = _SEVERAL if len(scenes) > 1 else _ONE
    picture = Image.new("RGB", (width * len(scenes), height))
    for column, scene in enumerate(scenes):
        where = region(scene)
        camera = (_TOP if scene.dimension == 2 else _CAMERA).framing(where.low, where.high, width / height, margin=1.08)
        picture.paste(Image.fromarray(hqmodel.render(scene, camera, (width, height))).convert("RGB"), (width * column, 0))
    picture.save(FOLDER / link, quality=88)


def main() -> None:
    """Write the pictures."""
    for page in PAGES:
        run(FOLDER / page, _draw)


if __name__ == "__main__":
    main()
