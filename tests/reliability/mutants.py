"""Presets damaged at random, in their bytes and in what they say: each is read as a scene or refused by PresetError.

Run as `python -m tests.reliability.mutants COUNT SEED`: reads so many with memory limited, prints what came of them, and ends
with an error at anything else than PresetError, at a scene that its own file does not give back, and beyond either limit.
"""

from __future__ import annotations

import json
import random
import resource
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from time import process_time
from typing import Any

from hqmodel.files import PresetError, builtin, parse
from hqmodel.files.dump import dumps
from hqmodel.files.strict import MAX_BYTES

CORPUS = Path(__file__).parent / "corpus"
# What reading one preset may take: bytes beyond what the program takes by itself, and seconds.
MEMORY, SECONDS = 512 << 20, 5.0
# What readers of JSON and of numbers stumble over.
SPICE: tuple[bytes, ...] = (
    *(b"NaN", b"-Infinity", b"1e999", b"-0", b"1e-320", b"0.05", b"1001", b"0x10", b"1_0", b"1.", b".5", b"+1", b"9" * 400),
    *(b"9" * 5000, b"true", b"null", b'""', b"{}", b"[]", b"[[[", b"}}", b'"', b"\\", b"\\ud800", b"\\u0000", b"\x00", b"\xff"),
    *(b"\xef\xbb\xbf", b",", b":", b'"group": "rim", ', b'"sign": 2, ', b'"version": 2, ', b'"dimension": 2, ', b"//", b"\r"),
    *(b"[" * 70 + b"]" * 70, b'{"a":' * 70 + b"1" + b"}" * 70, b"[" * 100_000, b'"__proto__": 1, ', b"../../etc/passwd"),
)
# What may stand where something else belongs.
ODD: tuple[Any, ...] = (
    *(None, True, 0, -0.0, 1, -1, 2, 0.05, 1000, 1001, 1e-320, 1e308, -1e308, 10**30, 10**299, "", "rim", "x", "\x00\n\x1b[31m"),
    *([], {}, [0, 0, 0], [1, 0, 0], [[]], {"": {}}, [0, 0, 0, 1], ["x", "x"], "a" * 10_000, [1] * 300, {"gamma": 2, "sign": 1}),
)


def seeds() -> list[bytes]:
    """The presets that are damaged: those built in, and the corpus."""
    paths = [preset.path for preset in builtin()] + sorted(CORPUS.glob("*.json"))
    return [path.read_bytes() for path in paths]


def mutants(count: int, seed: int) -> Iterator[bytes]:
    """So many damaged presets; the same seed gives the same ones."""
    chance, presets = random.Random(seed), seeds()
    for _ in range(count):
        data = chance.choice(presets)
        for _ in range(chance.choice((1, 1, 2, 4, 8))):
            data = chance.choice(WAYS)(data, chance, presets)
        yield data


def outcome(data: bytes) -> str:
    """What reading it came to: "a scene" or the first fault, by place and kind."""
    try:
        scene = parse(data, "mutant")
    except PresetError as error:
        text = str(error)
        assert all(line.isprintable() for line in text.split("\n")), "what presets hold is shown as text"
        return text.splitlines()[0].partition(", got ")[0]
    assert parse(dumps(scene).encode(), "again") == scene
    return "a scene"


def _flipped(data: bytes, chance: random.Random, _: list[bytes]) -> bytes:
    if not data:
        return data
    at = chance.randrange(len(data))
    return data[:at] + bytes([data[at] ^ 1 << chance.randrange(8)]) + data[at + 1 :]


def _cut(data: bytes, chance: random.Random, _: list[bytes]) -> bytes:
    start = chance.randrange(len(data) + 1)
    return data[:start] + data[start + chance.choice((1, 1, 8, 64, len(data))) :]


def _repeated(data: bytes, chance: random.Random, _: list[bytes]) -> bytes:
    start = chance.randrange(len(data) + 1)
    piece = data[start : start + chance.choice((1, 16, 256))]
    return data[:start] + piece * chance.choice((2, 3, 300)) + data[start + len(piece) :]


def _spiced(data: bytes, chance: random.Random, _: list[bytes]) -> bytes:
    start = chance.randrange(len(data) + 1)
    return data[:start] + chance.choice(SPICE) + data[start + chance.choice((0, 1, 3)) :]


def _spliced(data: bytes, chance: random.Random, presets: list[bytes]) -> bytes:
    other = chance.choice(presets)
    return data[: chance.randrange(len(data) + 1)] + other[chance.randrange(len(other) + 1) :]


def _resaid(data: bytes, chance: random.Random, _: list[bytes]) -> bytes:
    """Still JSON, where it was that: something in it is replaced, doubled or gone."""
    try:
        tree = json.loads(data)
    except (ValueError, RecursionError):
        return data
    here: Any = tree
    while isinstance(here, (dict, list)) and here:
        key = chance.choice(list(here) if isinstance(here, dict) else range(len(here)))
        if not isinstance(here[key], (dict, list)) or not here[key] or chance.random() < 0.2:
            _change(here, key, chance)
            break
        here = here[key]
    return json.dumps(tree).encode()


def _change(here: Any, key: Any, chance: random.Random) -> None:
    way = chance.random()
    if way < 0.7:
        here[key] = chance.choice(ODD)
    elif way < 0.85:
        del here[key]
    elif isinstance(here, list):
        here.extend([here[key]] * chance.choice((1, 300, 1100)))
    else:
        here[f"{key} "] = here.pop(key)


Way = Callable[[bytes, random.Random, list[bytes]], bytes]
WAYS: tuple[Way, ...] = (_flipped, _cut, _repeated, _spiced, _spliced, _resaid, _resaid, _resaid)


def main(count: int, seed: int) -> dict[str, Any]:
    """Reads so many mutants in little memory; how many were scenes, how many faults there were, and the longest time."""
    limit = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize() + MEMORY
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    told: dict[str, int] = {}
    slowest = 0.0
    for number, data in enumerate(mutants(count, seed)):
        started = process_time()
        try:
            came_to = outcome(data[: MAX_BYTES + 1])
        except BaseException as error:
            error.add_note(f"mutant {number} of seed {seed}")
            raise
        slowest = max(slowest, process_time() - started)
        told[came_to] = told.get(came_to, 0) + 1
    assert slowest < SECONDS, slowest
    return {"read": count, "scenes": told.pop("a scene", 0), "kinds of faults": len(told), "slowest": round(slowest, 3)}


if __name__ == "__main__":
    print(json.dumps(main(int(sys.argv[1]), int(sys.argv[2]))))
