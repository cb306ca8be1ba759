"""The package as users get it: a wheel that works from any folder, and an import that costs nothing."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest

import hqmodel

from .oldest import oldest

ROOT = Path(__file__).parents[1]
HEAVY = ("moderngl", "glfw", "imgui_bundle", "trimesh", "scipy")
PUBLIC = ["Scene", "Shape", "Strip", "fit", "load", "polygonize", "render", "save"]


def python(*arguments: str, **options: Any) -> str:
    """What a fresh interpreter prints."""
    done = subprocess.run([sys.executable, *arguments], check=False, capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def loaded_by(code: str) -> set[str]:
    """Which of the heavy packages, and of ours, a piece of code loads."""
    found = python("-c", f"import sys\n{code}\nprint(*sys.modules)", cwd=ROOT).split()
    return {name for name in found if name in HEAVY or name.startswith("hqmodel")}


def test_importing_the_package_loads_nothing_else() -> None:
    assert loaded_by("import hqmodel") == {"hqmodel"}


@pytest.mark.parametrize(
    "code", ["import hqmodel.cli", "import hqmodel; hqmodel.load; hqmodel.Scene; hqmodel.save", "import hqmodel.edit"]
)
def test_neither_opengl_nor_a_window_nor_a_mesher_comes_along(code: str) -> None:
    assert loaded_by(code).isdisjoint(HEAVY)


def test_meshing_needs_no_opengl() -> None:
    assert loaded_by("import hqmodel; hqmodel.polygonize").isdisjoint({"moderngl", "glfw", "imgui_bundle"})


def test_dependencies_have_a_range_whose_lower_end_can_be_tested() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    for dependency, pinned in zip(project["dependencies"], oldest(), strict=True):
        assert re.fullmatch(r"[a-z-]+>=[\d.]+,<\d+", dependency)
        assert pinned == dependency.partition(",")[0].replace(">=", "==")


def test_the_public_names_are_there() -> None:
    assert sorted(hqmodel.__all__) == PUBLIC
    assert set(dir(hqmodel)) >= set(PUBLIC)
    for name in PUBLIC:
        assert getattr(hqmodel, name).__module__.startswith("hqmodel.")
    with pytest.raises(AttributeError, match="module 'hqmodel' has no attribute 'polygonise'"):
        hqmodel.polygonise  # noqa: B018


def test_a_script_can_do_the_main_job(tmp_path: Path) -> None:
    scene = hqmodel.Scene(shapes=(hqmodel.Shape(strips=(hqmodel.Strip(normal=(1.0, 0.0, 0.0)),)),), bounds=((-2,) * 3, (2,) * 3))
    hqmodel.save(scene, tmp_path / "slab.json")
    assert hqmodel.load(tmp_path / "slab.json") == scene
    assert len(hqmodel.polygonize(scene, resolution=8).faces) > 0


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel, installed into a folder of its own."""
    folder = tmp_path_factory.mktemp("wheel")
    python("-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder), str(ROOT))
    (built,) = folder.glob("*.whl")
    install = ("-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--disable-pip-version-check")
    python(*install, "--target", str(folder / "site"), str(built))
    return folder / "site"


def installed(site: Path, folder: Path, *arguments: str) -> str:
    """What the installed program prints, run from another folder."""
    environment = {**os.environ, "PYTHONPATH": str(site)}
    return python(str(site / "bin" / "hqmodel"), *arguments, cwd=folder, env=environment)


def test_the_wheel_brings_all_it_needs(wheel: Path, tmp_path: Path) -> None:
    assert installed(wheel, tmp_path, "--version") == f"hqmodel {hqmodel.__version__}\n"
    presets = json.loads(installed(wheel, tmp_path, "presets", "--json"))["presets"]
    assert len(presets) >= 12
    for preset in presets:
        assert Path(preset["file"]).is_relative_to(wheel)


def test_the_wheel_exports_and_renders_from_any_folder(wheel: Path, tmp_path: Path) -> None:
    name = json.loads(installed(wheel, tmp_path, "presets", "--json"))["presets"][0]["name"]
    result = json.loads(installed(wheel, tmp_path, "export", name, "-o", "a.glb", "--resolution", "32", "--json"))
    assert result["watertight"] is True
    installed(wheel, tmp_path, "render", name, "-o", "a.png", "--size", "64x48")
    assert {path.name for path in tmp_path.iterdir()} == {"a.glb", "a.png"}


WINDOW = """
"$@" & program=$!
until window=$(xdotool search --onlyvisible --name " - hqmodel"); do
    kill -0 $program || exit 1
    sleep 0.1
done
xdotool getwindowname $window
kill -TERM $program
wait $program
echo ended with $?
"""


def test_the_wheel_opens_its_window_from_any_folder(wheel: Path, tmp_path: Path, display: str) -> None:
    (tmp_path / "mine.json").write_text('{"format": "hqmodel", "version": 1, "shapes": []}')
    environment = {**os.environ, "PYTHONPATH": str(wheel), "DISPLAY": display}
    command = ["sh", "-c", WINDOW, "sh", sys.executable, str(wheel / "bin" / "hqmodel"), "mine.json"]
    done = subprocess.run(command, check=False, capture_output=True, text=True, cwd=tmp_path, env=environment)
    assert (done.returncode, done.stdout) == (0, "mine - hqmodel\nended with 143\n"), done.stderr


def test_imports_go_one_way() -> None:
    python("-c", "from importlinter.cli import lint_imports; raise SystemExit(lint_imports(no_cache=True))", cwd=ROOT)
