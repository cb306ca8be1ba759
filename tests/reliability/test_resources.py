"""What a machine lacks is said in a sentence, and what is taken of it is given back."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from hqmodel.gpu import offscreen

from .objects import alive, alive_after

ROOT = Path(__file__).parents[2]


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
