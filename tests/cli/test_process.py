"""The program as a process: interrupted, killed off, its output cut off or its disk full, it ends cleanly."""

from __future__ import annotations

import json
import os
import pty
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from .conftest import BALL

PROGRAM = [sys.executable, "-m", "hqmodel"]
ROOT = Path(__file__).parents[2]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.chdir(tmp_path)
    Path("ball.json").write_text(json.dumps(BALL))
    yield tmp_path


def heed_interrupts() -> None:
    """Shells start what they put in the background deaf to Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def test_the_module_is_the_program(folder: Path) -> None:
    done = subprocess.run([*PROGRAM, "check", "ball.json"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "ball.json: ok\n", "")


@pytest.mark.parametrize(("number", "status", "message"), [(signal.SIGINT, 130, "interrupted\n"), (signal.SIGTERM, 143, "")])
def test_stopped_while_writing_it_leaves_nothing(folder: Path, number: int, status: int, message: str) -> None:
    os.mkfifo("p.csv")
    command = [*PROGRAM, "sample", "ball.json", "p.csv", "-o", "o.csv"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, preexec_fn=heed_interrupts) as process:
        with Path("p.csv").open("w") as points:
            points.write("x,y,z\n" + "0,0,0\n" * 100_000)
            points.flush()  # more than a pipe holds: the reader has begun, so the draft of o.csv is there
            assert len(list(folder.iterdir())) == 3
            process.send_signal(number)
            assert process.stderr is not None
            assert process.stderr.read() == message
        assert process.wait() == status
    assert {path.name for path in folder.iterdir()} == {"ball.json", "p.csv"}


@pytest.mark.parametrize(
    ("heed", "ended"), [(signal.SIG_DFL, (-signal.SIGINT, "", "")), (signal.SIG_IGN, (0, "ball.json: ok\n", ""))]
)
def test_interrupted_while_it_loads_it_just_ends(folder: Path, heed: signal.Handlers, ended: tuple[int, str, str]) -> None:
    """Without a traceback; and not at all where whoever started it wants interrupts ignored."""
    code = """
import signal, sys
class Interrupting:
    def find_spec(self, name, *_):
        if name == "hqmodel.cli.main":
            signal.raise_signal(signal.SIGINT)
sys.meta_path.insert(0, Interrupting())
from hqmodel.__main__ import main
main()
"""
    command = [sys.executable, "-c", code, "check", "ball.json"]
    done = subprocess.run(
        command, capture_output=True, text=True, check=False, preexec_fn=lambda: signal.signal(signal.SIGINT, heed)
    )
    assert (done.returncode, done.stdout, done.stderr) == ended


def test_on_a_terminal_it_shows_progress_and_stops_at_ctrl_c(folder: Path) -> None:
    screen, terminal = pty.openpty()
    command = [*PROGRAM, "export", "ball.json", "-o", "a.obj", "--resolution", "2000"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=terminal, preexec_fn=heed_interrupts) as process:
        os.close(terminal)
        shown = b""
        while b"Meshing" not in shown:
            shown += os.read(screen, 1000)
        process.send_signal(signal.SIGINT)
        threading.Thread(target=_drain, args=(screen,), daemon=True).start()
        assert process.communicate()[0] == b""
        assert process.returncode == 130
    assert {path.name for path in folder.iterdir()} == {"ball.json"}


def _drain(screen: int) -> None:
    """Read what a terminal is sent until its other end is closed, which Linux tells by an error."""
    try:
        while os.read(screen, 1000):
            pass
    except OSError:
        os.close(screen)


def test_away_from_a_terminal_it_shows_nothing(folder: Path) -> None:
    command = [*PROGRAM, "export", "ball.json", "-o", "a.obj", "--resolution", "16", "-q"]
    done = subprocess.run(command, capture_output=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")


def test_a_reader_that_hangs_up_is_no_error(folder: Path) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run([*PROGRAM, "presets", "--json"], stdout=writing, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writing)
    assert (done.returncode, done.stderr) == (0, "")


def test_a_full_disk_is_the_machines_fault(folder: Path) -> None:
    Path("p.csv").write_text("x,y,z\n0,0,0\n")
    full = subprocess.run(
        [*PROGRAM, "sample", "ball.json", "p.csv", "-o", "/dev/full"], capture_output=True, text=True, check=False
    )
    told = "/dev/full: expected a file that can be written, got: No space left on device\n"
    assert (full.returncode, full.stdout, full.stderr) == (3, "", told)
    with Path("/dev/full").open("w") as stdout:
        done = subprocess.run([*PROGRAM, "check", "ball.json"], stdout=stdout, stderr=subprocess.PIPE, text=True, check=False)
    assert (done.returncode, done.stderr) == (3, "output: No space left on device\n")


def test_closed_outputs_are_no_error(folder: Path) -> None:
    for closing in (">&-", "2>&-", "<&- >&- 2>&-"):
        command = f"'{sys.executable}' -m hqmodel export ball.json -o a.obj --resolution 8 {closing}"
        done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (0, ""), closing
