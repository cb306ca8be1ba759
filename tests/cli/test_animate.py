"""animate: films with the frames, order and time asked for, in one view; faults told, and nothing half-written."""

from __future__ import annotations

import json
import os
import stat
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageSequence

from .conftest import BALL, Command, files

Picture = NDArray[np.uint8]
SMALL = ["--size", "48x36"]


def frames(name: str) -> list[Picture]:
    with Image.open(name) as film:
        return [np.asarray(frame.convert("RGB")) for frame in ImageSequence.Iterator(film)]


def body(picture: Picture) -> NDArray[np.bool_]:
    """Where there is something of the ball's orange."""
    red, blue = picture[..., 0].astype(int), picture[..., 2].astype(int)
    return red - blue > 40


def told(hqmodel: Command, *arguments: object) -> dict[str, Any]:
    ended = hqmodel("animate", "ball.json", *SMALL, *arguments, "--json")
    assert (ended.status, ended.err) == (0, "")
    result: dict[str, Any] = json.loads(ended.out)
    return result


def test_a_gif_has_the_frames_and_the_time_asked_for(hqmodel: Command) -> None:
    result = told(hqmodel, "-o", "a.gif", "--sweep", "transform.scale[2]=0.3:1", "--frames", "5", "--seconds", "0.7")
    assert (result["frames"], result["duration"], result["files"]) == (5, 0.7, ["a.gif"])
    with Image.open("a.gif") as film:
        assert film.info["loop"] == 0
        delays = [frame.info["duration"] for frame in ImageSequence.Iterator(film)]
    assert sum(delays) == 700
    heights = [int(np.ptp(np.nonzero(body(frame))[0])) for frame in frames("a.gif")]
    assert len(heights) == 5
    assert heights == sorted(heights)
    assert heights[-1] > 1.5 * heights[0]


def test_nothing_is_cut_off_in_any_frame(hqmodel: Command) -> None:
    told(hqmodel, "-o", "a.gif", "--sweep", "transform.translation[0]=-3:3", "--frames", "3", "--view", "front")
    left, _, right = (body(frame) for frame in frames("a.gif"))
    assert np.any(left)
    for seen in (left, right):
        assert not np.any(seen[:, [0, -1]])
    assert np.abs(np.mean(np.nonzero(left)[1]) + np.mean(np.nonzero(right)[1]) - 47) < 1.5


def test_png_frames_are_numbered_and_come_back_in_a_ping_pong(hqmodel: Command) -> None:
    options = ["--sweep", "hardness=1:9", "--sweep", "gamma=1:9", "--ping-pong", "--frames", "6"]
    assert told(hqmodel, "-o", "a-##.png", *options)["files"] == [f"a-0{number}.png" for number in range(1, 7)]
    data = [Path(f"a-0{number}.png").read_bytes() for number in range(1, 7)]
    assert data[1:3] == data[:3:-1]
    assert len(set(data)) == 4
    assert files() == {"ball.json", *(f"a-0{number}.png" for number in range(1, 7))}


@pytest.mark.parametrize(
    ("name", "first"), [("a.png", "a_0001.png"), ("a%03d.png", "a001.png"), ("%d.png", "1.png"), ("#x.png", "1x.png")]
)
def test_names_of_frames(hqmodel: Command, name: str, first: str) -> None:
    result = told(hqmodel, "-o", name, "--sweep", "gamma=1:9", "--frames", "2")
    assert result["files"][0] == first
    assert files() == {"ball.json", *result["files"]}


def test_a_turntable_goes_round_once(hqmodel: Command) -> None:
    options = ["--set", "transform.scale=[2, 1, 0.5]", "--elevation", "0"]
    told(hqmodel, "-o", "turn#.png", "--turntable", "--frames", "4", "--azimuth", "0", *options)
    front, right, back, left = (frames(f"turn{number}.png")[0] for number in range(1, 5))
    wide = [int(np.ptp(np.nonzero(body(picture))[1])) for picture in (front, right, back, left)]
    assert wide[0] == wide[2] > 1.5 * wide[1] == 1.5 * wide[3]


def test_the_same_bytes_again(hqmodel: Command) -> None:
    for name in ("a.gif", "b.gif"):
        told(hqmodel, "-o", name, "--sweep", "gamma=1:9", "--turntable", "--frames", "3")
    assert Path("a.gif").read_bytes() == Path("b.gif").read_bytes()


def test_a_preset_s_own_animations(hqmodel: Command) -> None:
    sweeps = {"one": [1.0, 9.0], "two": [2.0, 8.0, 1.0]}
    kept = [{"name": name, "duration": 0.08, "sweeps": [{"path": "gamma", "values": v}]} for name, v in sweeps.items()]
    Path("moving.json").write_text(json.dumps({**BALL, "animations": kept}))
    first = hqmodel("animate", "moving.json", *SMALL, "-o", "a.png")
    assert (first.status, first.out) == (0, "a_0001.png to a_0002.png: 2 frames, 0.08 s, 48 x 36 pixels\n")
    assert hqmodel("animate", "moving.json", *SMALL, "-o", "b.png", "--animation", "two", "--frames", "3").status == 0
    assert not np.array_equal(frames("a_0001.png")[0], frames("b_0001.png")[0])
    ended = hqmodel("animate", "moving.json", *SMALL, "-o", "c.gif", "--animation", "three")
    assert (ended.status, ended.err) == (2, "--animation: expected 'one' or 'two', got 'three'\n")


def test_an_animation_at_fault_is_the_preset_s_fault(hqmodel: Command) -> None:
    wrong = {"sweeps": [{"path": "gamma", "values": [1, -1]}]}
    Path("wrong.json").write_text(json.dumps({**BALL, "animations": [wrong]}))
    ended = hqmodel("animate", "wrong.json", "-o", "a.gif")
    message = "wrong.json: animations[0].sweeps[0].values[1]: expected a number from 0.05 to 1000, got -1\n"
    assert ended == (1, "", message)


def ffmpeg(folder: Path, script: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A stand-in for ffmpeg, alone on the path."""
    folder.mkdir()
    program = folder / "ffmpeg"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", f"{folder}{os.pathsep}/usr/bin{os.pathsep}/bin")


def test_mp4_hands_raw_frames_of_even_sides_to_ffmpeg(
    hqmodel: Command, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path_factory.mktemp("tools") / "bin"
    ffmpeg(folder, 'for last; do :; done; echo "$@" > ' + str(folder / "said") + '; cat > "$last"', monkeypatch)
    options = ["--size", "31x21", "--sweep", "gamma=1:9", "--frames", "3", "--fps", "12"]
    assert hqmodel("animate", "ball.json", "-o", "a.mp4", *options).status == 0
    assert Path("a.mp4").stat().st_size == 3 * 32 * 22 * 3
    said = (folder / "said").read_text()
    for option in ("-s 32x22", "-r 12.000000", "-c:v libx264", "-pix_fmt yuv420p", "+faststart"):
        assert option in said
    assert files() == {"ball.json", "a.mp4"}


def test_what_ffmpeg_cannot_do_is_told(
    hqmodel: Command, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    options = ["--sweep", "gamma=1:9", "--frames", "2"]
    ffmpeg(tmp_path_factory.mktemp("tools") / "bin", "echo no such encoder >&2; exit 1", monkeypatch)
    ended = hqmodel("animate", "ball.json", *SMALL, "-o", "a.mp4", *options)
    assert ended == (3, "", "a.mp4: ffmpeg could not write it: no such encoder\n")
    monkeypatch.setenv("PATH", "")
    ended = hqmodel("animate", "ball.json", *SMALL, "-o", "a.mp4", *options)
    assert ended.status == 3
    assert ended.err.startswith("a.mp4: expected ffmpeg to write it with, found none: install it")
    assert files() == {"ball.json"}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["-o", "a.gif"], "ball.json: has no animation: say what changes with --sweep PATH=A:B, or --turntable"),
        (["-o", "a.webp", "--turntable"], "a.webp: expected a file name that ends in .gif or .png or .mp4, got .webp"),
        (["-o", "a.gif", "--sweep", "gamma=0:1"], "--sweep: values[0]: expected a number from 0.05 to 1000, got 0"),
        (
            ["-o", "a.gif", "--sweep", "gamma=1:2", "--sweep", "slice=0:1:2"],
            "--sweep: expected 2 values like the first sweep, got 'slice=0:1:2'",
        ),
        (["-o", "a.gif", "--sweep", "gamma=1:2", "--animation", "x"], "--sweep: expected sweeps or --animation, got both"),
        (["-o", "a.gif", "--turntable", "--seconds", "0"], "--seconds: expected a number above 0 and up to 3600, got 0"),
        (["-o", "a.gif", "--turntable", "--frames", "1"], "--frames: expected a number from 2 to 10000, got 1"),
        (
            ["-o", "a.gif", "--turntable", "--frames", "9", "--fps", "9", "--seconds", "1"],
            "--frames: expected two of --frames, --seconds and --fps, got all three",
        ),
        (["-o", "a.gif", "--turntable", "--fps", "60"], "a.gif: expected at most 50 frames a second in a GIF, got 60"),
    ],
)
def test_wrong_options_are_told(hqmodel: Command, arguments: list[str], message: str) -> None:
    assert hqmodel("animate", "ball.json", *arguments) == (2, "", message + "\n")
    assert files() == {"ball.json"}


def test_what_is_stopped_leaves_nothing(hqmodel: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    from hqmodel import gpu

    drawn: list[int] = []

    def interrupted(*arguments: Any, **options: Any) -> Any:
        drawn.append(1)
        raise KeyboardInterrupt

    monkeypatch.setattr(gpu, "render", interrupted)
    assert hqmodel("animate", "ball.json", *SMALL, "-o", "a.gif", "--turntable", "--frames", "4").status == 130
    assert drawn == [1]
    assert files() == {"ball.json"}
