"""What a machine lacks is said in a sentence, and what is taken of it is given back."""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
from pathlib import Path

import pytest

from hqmodel.edit import new_scene
from hqmodel.gpu import GpuError, offscreen, raycast, render

from ..app.outside import ROOT, SECONDS, surroundings
from .objects import alive, alive_after


def test_opengl_objects_are_given_back() -> None:
    ctx = offscreen()
    with ctx:
        before = alive(ctx)
        quarters = alive_after(ctx, 24)
        after = alive(ctx)
    ctx.release()
    assert len(set(quarters)) == 1, "after the first six scenes there are as many as after the last"
    assert quarters[0] > before
    assert after.textures == before.textures


@pytest.mark.parametrize(
    "lacking",
    [
        {"MESA_GL_VERSION_OVERRIDE": "2.1"},
        {"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent", "LIBGL_DRIVERS_PATH": "/nonexistent"},
        {"LIBGL_DRIVERS_PATH": "/nonexistent", "GBM_BACKENDS_PATH": "/nonexistent", "__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent"},
    ],
)
def test_without_opengl_one_sentence_says_what_to_install(tmp_path: Path, lacking: dict[str, str]) -> None:
    """Whether or not an X server is there, as the window tests' is; what Mesa says beside that is not ours."""
    command = [sys.executable, "-m", "hqmodel", "render", "soft-die", "-o", str(tmp_path / "a.png"), "--size", "16x16"]
    environment = {**os.environ, **lacking}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment, cwd=ROOT)
    assert (done.returncode, done.stdout) == (3, "")
    (told,) = [line for line in done.stderr.splitlines() if not line.startswith("libGL error")]
    assert "OpenGL 3.3 is needed" in told
    assert "libegl1" in told
    assert not list(tmp_path.iterdir())


def test_what_opengl_failed_in_is_refused_and_the_next_is_drawn() -> None:
    """As far as anybody is told of it: a failure of OpenGL's raises nothing by itself, and gives wrong pictures."""
    opengl = ctypes.CDLL("libOpenGL.so.0")

    def failing(share: float, doing: str) -> None:
        opengl.glEnable(0xFFFF)

    with pytest.raises(GpuError, match=r"OpenGL has failed \(GL_INVALID_ENUM\)"):
        render(new_scene(), size=(16, 16), samples=1, progress=failing)
    with offscreen() as ctx:
        failing(0.0, "")
        with pytest.raises(GpuError, match="OpenGL has failed"):
            raycast(new_scene(), [[0, 0, 9]], [[0, 0, -1]], ctx)
        assert raycast(new_scene(), [[0, 0, 9]], [[0, 0, -1]], ctx)[0] == pytest.approx(8, abs=1e-4)
    ctx.release()
    picture = render(new_scene(), size=(16, 16), samples=1)
    assert (picture[8, 8] != picture[0, 0]).any()


def test_without_its_fonts_the_window_has_imguis_own(display: str, tmp_path: Path) -> None:
    code = """
import sys
from pathlib import Path
from imgui_bundle import hello_imgui
from tests.app.drive import main
hello_imgui.set_assets_folder("/nonexistent")
assert not hello_imgui.asset_exists("fonts/DroidSans.ttf")
sys.exit(main("tests.app.scenarios:turns_and_resets", Path(sys.argv[1])))
"""
    command, environment = [sys.executable, "-c", code, str(tmp_path)], surroundings(display, tmp_path)
    ended = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=SECONDS)
    assert ended.returncode == 0, ended.stdout + ended.stderr
