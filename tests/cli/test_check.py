"""check: a line for each problem of each preset."""

from __future__ import annotations

import json
from pathlib import Path

from .conftest import BALL, Command, Ended


def write_bad() -> None:
    strips = [{"normal": [1, 0, 0], "gamma": 0.01}, {"normal": [1, 0]}]
    Path("bad.json").write_text(json.dumps({**BALL, "slice": "t", "shapes": [{"strips": strips}]}))


LINES = [
    "slice: expected a finite number, got 't'",
    "shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got 0.01",
    "shapes[0].strips[1].normal: expected a list of 3 numbers, got [1, 0]",
]


def test_a_valid_preset_is_ok(hqmodel: Command) -> None:
    assert hqmodel("check", "ball.json") == Ended(0, "ball.json: ok\n", "")
    assert hqmodel("check", "ball.json", "-q") == Ended(0, "", "")


def test_each_problem_of_each_preset_has_a_line(hqmodel: Command) -> None:
    write_bad()
    ended = hqmodel("check", "bad.json", "ball.json", "qqqq.json")
    assert ended.status == 1
    assert ended.out == "ball.json: ok\n"
    assert ended.err.splitlines() == [
        *[f"bad.json: {line}" for line in LINES],
        "qqqq.json: expected a file, got nothing of that name",
    ]


def test_json_has_it_all(hqmodel: Command) -> None:
    write_bad()
    ended = hqmodel("check", "bad.json", "ball.json", "--json")
    assert ended.status == 1
    assert json.loads(ended.out) == {
        "ok": False,
        "files": [{"file": "bad.json", "ok": False, "problems": LINES}, {"file": "ball.json", "ok": True, "problems": []}],
    }
