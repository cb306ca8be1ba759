"""How much memory there is, by what systems say of it; and work that would want more is refused before it is begun."""

from __future__ import annotations

import os
import re
import resource
import subprocess
import sys
from math import inf
from pathlib import Path

import pytest

from hqmodel import memory, mesh
from hqmodel.edit import new_scene
from hqmodel.fit import FitError, read
from hqmodel.fit.room import must_have_room
from hqmodel.mesh import MeshError
from hqmodel.mesh.room import quads_must_have_room

GB = 10**9


@pytest.fixture
def system(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A system that says nothing yet: its folders are empty."""
    (tmp_path / "proc/self").mkdir(parents=True)
    (tmp_path / "groups/service").mkdir(parents=True)
    monkeypatch.setattr(memory, "_PROC", tmp_path / "proc")
    monkeypatch.setattr(memory, "_GROUPS", tmp_path / "groups")
    monkeypatch.setattr(memory, "_own", lambda: inf)
    (tmp_path / "proc/meminfo").write_text("MemTotal:  8000000 kB\nMemFree:  10 kB\nMemAvailable:    4000000 kB\n")
    return tmp_path


def group(folder: Path, limit: str, used: int, cached: int = 0) -> None:
    for name, text in (("max", limit), ("current", str(used)), ("stat", f"anon 5\ninactive_file {cached}\n")):
        (folder / f"memory.{name}").write_text(f"{text}\n")


def test_the_machines(system: Path) -> None:
    assert memory.available() == 4_096_000_000
    (system / "proc/meminfo").unlink()
    assert memory.available() > 1e8, "all that this machine has"


def test_a_containers(system: Path) -> None:
    group(system / "groups", str(3 * GB), 2 * GB, GB)
    assert memory.available() == 2 * GB, "what files are cached in is given back"
    group(system / "groups", str(GB), 2 * GB)
    assert memory.available() == 0


def test_a_groups_and_those_that_it_is_part_of(system: Path) -> None:
    (system / "proc/self/cgroup").write_text("0::/service/worker\n")
    (system / "groups/service/worker").mkdir()
    group(system / "groups/service/worker", "max", GB)
    group(system / "groups/service", str(2 * GB), GB)
    assert memory.available() == GB


@pytest.mark.parametrize("free", [3e8, 1e9, 4e9])
def test_what_is_refused_for_want_of_memory_and_what_would_fit(monkeypatch: pytest.MonkeyPatch, free: float) -> None:
    monkeypatch.setattr(memory, "available", lambda: free)
    with pytest.raises(
        MeshError, match=r"^resolution: expected at most \d+ in the .+ free, got 2048, which needs about"
    ) as caught:
        mesh.must_have_room(new_scene(), 2048)
    found = re.search(r"at most (\d+)", str(caught.value))
    assert found
    mesh.must_have_room(new_scene(), int(found[1]))
    with pytest.raises(MeshError):
        mesh.must_have_room(new_scene(), int(found[1]) + 1)
    with pytest.raises(MeshError):
        mesh.must_have_room(new_scene(), int(found[1]), reducing=True)


@pytest.mark.parametrize("free", [3e8, 1e9])
def test_a_radial_grid_is_refused_and_what_would_fit_is_not(monkeypatch: pytest.MonkeyPatch, free: float) -> None:
    monkeypatch.setattr(memory, "available", lambda: free)
    with pytest.raises(MeshError, match=r"^resolution: expected at most \d+ in the .+ free, got 4096, which") as caught:
        mesh.radial_quads(new_scene(), 4096)
    found = re.search(r"at most (\d+)", str(caught.value))
    assert found
    quads_must_have_room(int(found[1]))
    with pytest.raises(MeshError):
        quads_must_have_room(int(found[1]) + 1)


HEADER = "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
# Files of a hundred million points or so each, of which only the beginning is there: the rest is a hole.
CLOUDS = {
    "a.ply": (HEADER.format("binary_little_endian", 500_000_000), 6 * GB, "points"),
    "b.ply": (HEADER.format("ascii", 500_000_000), 15 * GB, "points"),
    "c.ply": ("ply\nformat ascii 1.0\nelement vertex 5\nelement face 100000000\n", 9 * GB, "points and faces"),
    "d.xyz": ("0.123456 0.123456 0.123456\n" * 4000, 15 * GB, "points"),
    "e.obj": ("v 0.123456 0.123456 0.123456\n" * 4000, 15 * GB, "lines"),
    "f.stl": (80 * "\0" + (10**8).to_bytes(4, "little").decode("latin-1"), 84 + 5 * GB, "triangles"),
    "g.stl": ("facet normal 0 0 1\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\n" * 2000, 15 * GB, "triangles"),
    "h.xyz": ("", 15 * GB, "points"),
}


@pytest.mark.parametrize("name", CLOUDS)
def test_clouds_are_refused_before_they_are_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    beginning, size, noun = CLOUDS[name]
    path = tmp_path / name
    path.write_text(beginning, encoding="latin-1")
    os.truncate(path, size)
    monkeypatch.setattr(memory, "available", lambda: float(GB))
    with pytest.raises(FitError, match=rf"^expected at most [\d,]+ {noun} in the 1 GB of memory that are free, got ") as caught:
        read(path)
    fits, got = (int(number.replace(",", "")) for number in re.findall(r"(?:at most|got(?: about)?) ([\d,]+)", str(caught.value)))
    assert 0 < fits < got
    needed = re.search(r"about (\S+) GB$", str(caught.value))
    assert needed
    monkeypatch.setattr(memory, "available", lambda: 1.1 * GB * float(needed[1]))
    must_have_room(path, path.suffix)


def test_what_has_no_surface_is_left_to_the_mesher(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "available", lambda: 0.0)
    mesh.must_have_room(new_scene().changed(shapes=()), 64)


@pytest.mark.parametrize(
    "command",
    [
        ["export", "apple", "--resolution", "2000", "-o", "a.stl"],
        ["render", "apple", "--size", "8000x8000", "-o", "a.png"],
        ["fit", "cloud.xyz", "-o", "a.json"],
    ],
)
def test_the_command_line_says_what_would_fit(tmp_path: Path, command: list[str]) -> None:
    """Within the shell's own limit, as with ulimit -v."""
    limit = 1_500_000_000
    cloud = tmp_path / "cloud.xyz"
    cloud.write_text("1 2 3\n" * 11_000)
    os.truncate(cloud, 2 * GB)
    done = subprocess.run(
        [sys.executable, "-m", "hqmodel", *command],
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)),
    )
    assert (done.returncode, done.stdout) == (1, "")
    assert re.fullmatch(
        r".+: expected at most \S+( points)? in the .+ of memory that are free, got (about )?\S+, which needs? about .+\n",
        done.stderr,
    )
    assert list(tmp_path.iterdir()) == [cloud]
