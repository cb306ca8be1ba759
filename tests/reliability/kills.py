"""Saves and exports killed at each of their system calls, once as the call begins and once as it has ended.

Run as `python -m tests.reliability.kills FOLDER EVERY WORK...`; prints how many times each was killed. The system's own tracer
(ptrace) does the counting: a child is let go from one stop to the next and killed by SIGKILL at the n-th, for every n (or every
so many, where the work is long) until it ends by itself.
"""

from __future__ import annotations

import ctypes
import json
import os
import signal
import sys
from collections.abc import Callable
from contextlib import AbstractContextManager
from importlib import import_module
from pathlib import Path
from shutil import rmtree
from typing import Any, BinaryIO

import numpy as np

from hqmodel import files
from hqmodel.edit import new_scene
from hqmodel.files import atomic, dump

_TRACE_ME, _GO_TO_THE_NEXT_CALL = 0, 24
# Older than any draft that is still being written to, in seconds.
_LONG_AGO = 100_000
_ptrace = ctypes.CDLL(None, use_errno=True).ptrace
_ptrace.argtypes = [ctypes.c_long, ctypes.c_long, ctypes.c_void_p, ctypes.c_void_p]
_ptrace.restype = ctypes.c_long

Work = Callable[[], object]
OLD, NEW = (new_scene().changed(name=word * 5000) for word in ("old ", "new "))


def begin() -> None:
    """From here on the child stops at its system calls."""
    if _ptrace(_TRACE_ME, 0, None, None):
        raise OSError(ctypes.get_errno(), "ptrace is not permitted here")
    os.kill(os.getpid(), signal.SIGSTOP)


def killed(work: Work, number: int) -> bool:
    """Whether the work, in a child of its own, was killed at its stop of that number; else it has ended well by itself."""
    child = os.fork()
    if child == 0:
        status = 1
        try:
            work()
            status = 0
        finally:
            os._exit(status)
    for stop in range(number):
        status = os.waitpid(child, 0)[1]
        if not os.WIFSTOPPED(status):
            assert os.waitstatus_to_exitcode(status) == 0, "the work failed by itself"
            return False
        if stop < number - 1 and _ptrace(_GO_TO_THE_NEXT_CALL, child, None, None):
            raise OSError(ctypes.get_errno(), "the child can't be traced")
    os.kill(child, signal.SIGKILL)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == -signal.SIGKILL
    return True


def every_kill(work: Work, check: Callable[[], None], every: int) -> int:
    """Kill the work at every stop, or at every so many, and check what is there each time; how many kills that were."""
    kills = 0
    while killed(work, 1 + every * kills):
        kills += 1
        check()
    check()
    return kills


def traced_from_the_first_file() -> None:
    """The command lines' files are what is watched: the child stops from where it opens the first to write."""
    begun = False

    def watched(path: str | os.PathLike[str]) -> AbstractContextManager[BinaryIO]:
        nonlocal begun
        if not begun:
            begin()
            begun = True
        return atomic(path)

    for module in ("hqmodel.files", "hqmodel.files.dump"):
        sys.modules[module].atomic = watched  # type: ignore[attr-defined]


def save_over(folder: Path, every: int) -> int:
    """Over an earlier file whose permissions are its own."""
    path = folder / "clay.json"
    return _saves(path, path, every)


def save_through_a_link(folder: Path, every: int) -> int:
    """Over the file that a link leads to, in another folder."""
    path, link = folder / "deep" / "clay.json", folder / "link.json"
    path.parent.mkdir()
    link.symlink_to(path)
    kills = _saves(link, path, every)
    assert link.is_symlink()
    return kills


def save_with_backup(folder: Path, every: int) -> int:
    """As the window does: what was there is kept first, and is in the file or among the versions at every moment."""
    path = folder / "clay.json"
    versions = files.backup_folder(path)

    def work() -> None:
        begin()
        assert files.back_up(path)
        files.save(NEW, path)

    def check() -> None:
        kept = [version.read_bytes() for version in versions.glob("*.json")]
        assert kept in ([], [BYTES_OLD])
        assert path.read_bytes() == BYTES_OLD or kept
        if versions.exists():
            rmtree(versions)

    return _saves(path, path, every, work, check)


def save_new(folder: Path, every: int) -> int:
    """Where there was no file."""
    path = folder / "clay.json"

    def work() -> None:
        begin()
        files.save(NEW, path)

    def check() -> None:
        whole([path], [{None, BYTES_NEW}])
        path.unlink(missing_ok=True)

    return every_kill(work, check, every)


def autosave(folder: Path, every: int) -> int:
    """The second copy of a window's work: one of the two is found by the next window, and nothing is left once it is let go."""

    def work() -> None:
        ring, origin = files.Ring(), files.Origin("clay")
        ring.keep(OLD, origin)
        begin()
        ring.keep(NEW, origin)

    def check() -> None:
        (found,) = files.lost()
        assert files.load(found.copies[0]) in (OLD, NEW)
        found.discard()
        assert not list(files.state_folder().joinpath("autosave").iterdir())

    return every_kill(work, check, every)


def export(folder: Path, every: int) -> int:
    """Two files from one mesh, over earlier ones."""
    from hqmodel import mesh  # late: a small process forks in less time

    body = mesh.polygonize(new_scene(), 8)
    mesh.polygonize = lambda *arguments, **options: body
    files.save(new_scene(), folder / "ball.json")
    names = [str(folder / name) for name in ("ball.obj", "ball.3mf")]
    arguments = ["export", str(folder / "ball.json"), "-q", "-o", names[0], "-o", names[1]]
    return _command(arguments, [Path(name) for name in names], every)


def fitted(folder: Path, every: int) -> int:
    """The preset that a fit comes to, over an earlier one."""
    fitting: Any = import_module("hqmodel.fit")
    cloud, preset = folder / "cloud.xyz", folder / "fitted.json"
    points = np.random.default_rng(1).normal(size=(200, 3))
    np.savetxt(cloud, points / np.linalg.norm(points, axis=1, keepdims=True))
    found = fitting.fit(*fitting.read(cloud), strips=3)
    fitting.fit = lambda *arguments, **options: found
    return _command(["fit", str(cloud), "-q", "-o", str(preset)], [preset], every)


def whole(paths: list[Path], permitted: list[set[bytes | None]]) -> None:
    """Each file holds one of what it may; what the killed left is made old, for the next to put away."""
    for path, contents in zip(paths, permitted, strict=True):
        assert (path.read_bytes() if path.exists() else None) in contents, path
    for draft in paths[0].parent.glob(".hqmodel-*.tmp"):
        os.utime(draft, (_LONG_AGO, _LONG_AGO))


def _saves(path: Path, target: Path, every: int, work: Work | None = None, also: Callable[[], None] = lambda: None) -> int:
    def save() -> None:
        begin()
        files.save(NEW, path)

    def check() -> None:
        whole([target], [{BYTES_OLD, BYTES_NEW}])
        assert target.stat().st_mode & 0o777 == 0o640
        also()
        target.write_bytes(BYTES_OLD)

    target.write_bytes(BYTES_OLD)
    target.chmod(0o640)
    return every_kill(work or save, check, every)


def _command(arguments: list[str], paths: list[Path], every: int) -> int:
    """A command line whose work is done, and whose files are watched."""
    from hqmodel.cli import run

    assert run(arguments) == 0
    new = [path.read_bytes() for path in paths]

    def check() -> None:
        whole(paths, [{b"old", content} for content in new])
        for path in paths:
            path.write_bytes(b"old")

    def work() -> None:
        traced_from_the_first_file()
        assert run(arguments) == 0

    for path in paths:
        path.write_bytes(b"old")
    return every_kill(work, check, every)


BYTES_OLD, BYTES_NEW = (dump.dumps(scene).encode() for scene in (OLD, NEW))
WORKS = {work.__name__: work for work in (save_over, save_through_a_link, save_with_backup, save_new, autosave, export, fitted)}


def main(folder: Path, every: int, works: list[str]) -> dict[str, int]:
    """How many times each work was killed, in a folder of its own that holds no draft when all is done."""
    kills = {}
    for name in works:
        own = folder / name
        own.mkdir()
        os.environ["XDG_STATE_HOME"] = str(own / "state")
        kills[name] = WORKS[name](own, every)
        assert not list(own.rglob(".hqmodel-*")), name
    return kills


if __name__ == "__main__":
    print(json.dumps(main(Path(sys.argv[1]), int(sys.argv[2]), sys.argv[3:] or list(WORKS))))
