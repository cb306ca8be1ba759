"""A file is there whole or not at all, whatever happens, and keeps what it had."""

from __future__ import annotations

import errno
import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from hqmodel.files import atomic

ROOT = Path(__file__).parents[2]


def left(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def test_the_file_appears_at_the_end(tmp_path: Path) -> None:
    with atomic(tmp_path / "a") as stream:
        stream.write(b"new")
        assert not (tmp_path / "a").exists()
    assert (tmp_path / "a").read_bytes() == b"new"
    assert left(tmp_path) == {"a"}


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt, SystemExit, OSError])
def test_nothing_is_left_of_a_failure(tmp_path: Path, error: type[BaseException]) -> None:
    (tmp_path / "old").write_bytes(b"old")
    for name in ("old", "new"):
        with pytest.raises(error), atomic(tmp_path / name) as stream:
            stream.write(b"half")
            raise error
    assert left(tmp_path) == {"old"}
    assert (tmp_path / "old").read_bytes() == b"old"


def test_permissions_stay(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"old")
    path.chmod(0o640)
    with atomic(path) as stream:
        stream.write(b"new")
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


def test_a_new_file_has_the_permissions_of_any_new_file(tmp_path: Path) -> None:
    (tmp_path / "any").write_bytes(b"")
    with atomic(tmp_path / "a") as stream:
        stream.write(b"new")
    assert (tmp_path / "a").stat().st_mode == (tmp_path / "any").stat().st_mode


def test_a_link_is_followed_and_stays(tmp_path: Path) -> None:
    (tmp_path / "deep").mkdir()
    (tmp_path / "deep" / "real").write_bytes(b"old")
    (tmp_path / "link").symlink_to(Path("deep") / "real")
    with atomic(tmp_path / "link") as stream:
        stream.write(b"new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "deep" / "real").read_bytes() == b"new"


def test_a_link_to_nothing_yet_makes_its_target(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to("real")
    with atomic(tmp_path / "link") as stream:
        stream.write(b"new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_bytes() == b"new"


def test_a_device_stays_a_device() -> None:
    with atomic(os.devnull) as stream:
        stream.write(b"new")
    assert stat.S_ISCHR(Path(os.devnull).stat().st_mode)


def test_a_full_disk_is_told() -> None:
    with pytest.raises(OSError) as caught, atomic("/dev/full") as stream:
        stream.write(b"new")
        stream.flush()
    assert caught.value.errno == errno.ENOSPC


def test_folders_and_missing_folders_are_told_by_the_name_that_was_asked_for(tmp_path: Path) -> None:
    with pytest.raises(IsADirectoryError) as folder, atomic(tmp_path):
        pass
    assert folder.value.filename == str(tmp_path)
    with pytest.raises(FileNotFoundError) as missing, atomic(tmp_path / "no" / "a"):
        pass
    assert missing.value.filename == str(tmp_path / "no" / "a")


def test_the_bytes_are_on_the_disk_before_the_name_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[str] = []
    fsync, replace = os.fsync, Path.replace

    def watched_fsync(descriptor: int) -> None:
        done.append("folder" if stat.S_ISDIR(os.fstat(descriptor).st_mode) else f"file of {os.fstat(descriptor).st_size}")
        fsync(descriptor)

    def watched_replace(self: Path, target: Path) -> Path:
        done.append("name")
        return replace(self, target)

    monkeypatch.setattr(os, "fsync", watched_fsync)
    monkeypatch.setattr(Path, "replace", watched_replace)
    with atomic(tmp_path / "a") as stream:
        stream.write(b"12345")
    assert done == ["file of 5", "name", "folder"]


KILLER = """
import os, random, signal, sys, time
from hqmodel.files import load, save

path, rounds = sys.argv[1], int(sys.argv[2])
scenes = [load(path).changed(name=letter * 200_000) for letter in "ab"]
moments = random.Random(5)
started = time.perf_counter()
for scene in scenes:
    save(scene, path)
both = time.perf_counter() - started

for _ in range(rounds):
    saver = os.fork()
    if saver == 0:
        while True:
            for scene in scenes:
                save(scene, path)
    time.sleep(moments.uniform(0.0, 2 * both))
    os.kill(saver, signal.SIGKILL)
    assert os.waitpid(saver, 0)[1] == signal.SIGKILL
    name = load(path).name
    assert name in [scene.name for scene in scenes]
    print(name[0], end="")
"""


def test_killed_at_any_moment_of_a_save_the_old_file_or_the_new_one_is_there(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_text('{"format": "hqmodel", "version": 1, "shapes": []}')
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}  # no threads, so that it may fork
    command = [sys.executable, "-c", KILLER, str(path), "100"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment, cwd=ROOT)
    assert (done.returncode, done.stderr) == (0, "")
    assert len(done.stdout) == 100
    assert set(done.stdout) == {"a", "b"}


def test_what_is_open_already_is_written_on_and_not_replaced(tmp_path: Path) -> None:
    program = "from hqmodel.files import atomic\nwith atomic('/dev/stdout') as stream: stream.write(b'body\\n')"
    with (tmp_path / "log").open("wb", buffering=0) as log:
        log.write(b"head\n")
        subprocess.run([sys.executable, "-c", program], stdout=log, cwd=ROOT, check=True)
        log.write(b"tail\n")
    assert (tmp_path / "log").read_bytes() == b"head\nbody\ntail\n"
    assert left(tmp_path) == {"log"}


def test_what_a_crash_left_is_removed_once_nobody_can_be_writing_it(tmp_path: Path) -> None:
    forsaken, busy = tmp_path / ".hqmodel-0123456789abcdef.tmp", tmp_path / ".hqmodel-fedcba9876543210.tmp"
    for draft in (forsaken, busy):
        draft.write_bytes(b"half")
    os.utime(forsaken, (0, 0))
    with atomic(tmp_path / "a") as stream:
        stream.write(b"new")
    assert left(tmp_path) == {"a", busy.name}
