"""Random gestures with the mouse and the keys in the real window, again and again saved and reloaded, and all undone at the end.

A few of them are among the scenarios; `make reliability` makes a thousand.
"""

from __future__ import annotations

import json
from collections.abc import Sequence

import numpy as np
from imgui_bundle import imgui
from numpy.random import Generator
from numpy.typing import NDArray

from hqmodel.app import filing
from hqmodel.app.asks import Open
from hqmodel.app.hands.hand import known_handles
from hqmodel.app.intents import Do, Drop
from hqmodel.app.tools.reach import pivot
from hqmodel.field import Terms, value

from .drive import Hands
from .scenarios_hands import aim, goto, move

Key = imgui.Key
CTRL, SHIFT, ALT = Key.mod_ctrl, Key.mod_shift, Key.mod_alt
TOOLS = [Key._1, Key._2, Key._3, Key._4, Key._5, Key._6, Key._7, Key.b]
ARRANGING = ("move", "turn", "scale")
MODAL = [Key.g, Key.r, Key.s, Key.h]
AXES = [Key.x, Key.y, Key.z]
KEYS = [Key.left_bracket, Key.right_bracket, CTRL | Key.d, Key.x, CTRL | Key.z, CTRL | SHIFT | Key.z, Key.a, ALT | Key.a]
LOOKS = [Key.keypad1, Key.keypad3, Key.keypad7, Key.keypad5, Key.f]
# Beyond so many strips some shapes are taken away again, so that the picture stays quick to draw.
MOST = 24


def long(hands: Hands) -> None:
    """A thousand, told in numbers in a file."""
    told = stir(hands, gestures=1000, every=25, seed=3)
    (hands.folder / "stirred.json").write_text(json.dumps(told))


def stir(hands: Hands, gestures: int, every: int, seed: int) -> dict[str, int]:
    """Make so many gestures, look at the picture of what was saved after every so many of them, and undo them all."""
    chance, session = np.random.default_rng(seed), hands.session
    first, saves = session.scene, 0
    points = chance.uniform(-2, 2, (50, 3))
    for number in range(1, gestures + 1):
        gesture = (_drawn, _drawn, _drawn, _handled, _grabbed, _wheeled, _pressed, _looked)[int(chance.integers(8))]
        gesture(hands, chance)
        assert session.held is None
        assert not session.dialogs, session.dialogs
        assert np.all(np.isfinite(value(Terms.of(session.scene), points)))
        _kept_small(hands)
        if number % every == 0:
            _same_when_reloaded(hands, f"{saves}.json")
            saves += 1
    steps = len(session.history.labels)
    while session.history.can_undo:
        session.apply([Do("undo")])
    assert session.scene == first
    return {"gestures": gestures, "steps": steps, "reloaded": saves}


def _drawn(hands: Hands, chance: Generator) -> None:
    """A tool's drag over the body, with keys held or pressed meanwhile; a click where it doesn't move."""
    hands.keys(_one(chance, TOOLS))
    goto(hands, _on_the_body(hands, chance))
    if hands.session.kit.tool in ARRANGING and hands.session.selection.shapes:
        middle = aim(hands).pixel(pivot(hands.session.scene, hands.session.selection.shapes))
        goto(hands, np.clip(middle + chance.uniform(-30, 30, 2), 60, np.array(aim(hands).size) - 60))
    _dragged(hands, chance)


def _handled(hands: Hands, chance: Generator) -> None:
    """A click on a face, and then a drag of one of its handles."""
    hands.keys(Key._1)
    goto(hands, _on_the_body(hands, chance))
    hands.ctx.mouse_click()
    hands.settle()
    known = known_handles(hands.session, aim(hands))
    if known is not None and np.all(np.abs(known.middle - np.array(aim(hands).size) / 2) < np.array(aim(hands).size) / 3):
        goto(hands, [known.middle, known.arrow.mean(axis=0), known.ring[5]][int(chance.integers(3))])
        _dragged(hands, chance)


def _grabbed(hands: Hands, chance: Generator) -> None:
    """A key that takes hold of what is selected, an axis or none, a number or none; taken or put back."""
    goto(hands, _on_the_body(hands, chance))
    hands.keys(_one(chance, MODAL))
    move(hands, chance.uniform(-60, 60, 2))
    if chance.random() < 0.5:
        hands.keys(_one(chance, AXES))
    if chance.random() < 0.3:
        hands.ctx.key_chars(str(chance.choice(["0.2", "-0.4", "1.5", "-", "30"])))
        hands.settle()
    hands.keys(Key.enter if chance.random() < 0.8 else Key.escape)
    _let_go(hands)


def _wheeled(hands: Hands, chance: Generator) -> None:
    """The exponent of the face under the pointer by the wheel."""
    goto(hands, _on_the_body(hands, chance))
    hands.ctx.key_down(CTRL)
    hands.ctx.mouse_wheel_y(float(chance.choice([-3, -1, 1, 2])))
    hands.settle()
    hands.ctx.key_up(CTRL)
    hands.settle()


def _pressed(hands: Hands, chance: Generator) -> None:
    hands.keys(_one(chance, KEYS))


def _looked(hands: Hands, chance: Generator) -> None:
    """The view turned, and from time to time changed."""
    goto(hands, _on_the_body(hands, chance))
    hands.ctx.mouse_down(imgui.MouseButton_.middle)
    hands.settle()
    move(hands, chance.uniform(-90, 90, 2))
    hands.ctx.mouse_up(imgui.MouseButton_.middle)
    hands.settle()
    hands.keys(_one(chance, LOOKS) if chance.random() < 0.5 else Key.home)


def _dragged(hands: Hands, chance: Generator) -> None:
    held = _one(chance, [0, 0, 0, CTRL, SHIFT])
    hands.ctx.mouse_down()
    hands.settle()
    for _ in range(int(chance.integers(0, 4))):
        move(hands, chance.uniform(-40, 40, 2))
        if held:
            hands.ctx.key_down(held)
    if chance.random() < 0.2:
        hands.keys(_one(chance, [Key.tab, Key.escape, Key._3]))
    hands.ctx.mouse_up()
    hands.settle()
    if held:
        hands.ctx.key_up(held)
    _let_go(hands)


def _let_go(hands: Hands) -> None:
    """Where a click began nothing, or a number was no number, something may still be held: back with it."""
    if hands.session.held is not None:
        hands.keys(Key.escape)
    if hands.session.history.dragging:
        hands.session.apply([Drop()])
    hands.settle()


def _kept_small(hands: Hands) -> None:
    """Few strips, some clay, and the body in view."""
    session = hands.session
    if session.scene.strip_count > MOST:
        session.apply([Do("select all"), Do("delete")])
    if not any(shape.visible and shape.coefficient > 0 for shape in session.scene.shapes):
        session.apply([Do("add block"), Do("frame all")])


def _same_when_reloaded(hands: Hands, name: str) -> None:
    """What is saved and opened again is the same scene, in the same picture."""
    session, path = hands.session, hands.folder / name
    goto(hands, (-40, -40))  # beside the viewport: nothing is lit
    before, document, scene, view = _picture(hands), session.document, session.scene, session.view
    filing.write(session, path)
    session.apply([Open(path)])
    assert session.document is not document
    assert session.scene.changed(view={}) == scene.changed(view={})
    assert np.array_equal(_picture(hands), before)
    session.show(document)
    session.view = view
    hands.settle()


def _picture(hands: Hands) -> NDArray[np.uint8]:
    """The viewport's own, as fine as it gets; taken while it is drawn, as OpenGL is another thread's than the test's."""
    window, settings, taken = hands.window, hands.session.settings, list[NDArray[np.uint8]]()
    draw, spare = window.draw, window.spare

    def taking(size: tuple[int, int]) -> int:
        texture = draw(size)
        if not window.canvas.unfinished:
            taken.append(window.canvas.pixels())
        return texture

    hands.session.settings = settings.preferring(refining=True)
    window.draw, window.spare = taking, lambda: 1.0  # type: ignore[method-assign]
    hands.settle(3)
    taken.clear()
    hands.wait(lambda: bool(taken))
    window.draw, window.spare = draw, spare  # type: ignore[method-assign]
    hands.session.settings = settings
    return taken[-1]


def _on_the_body(hands: Hands, chance: Generator) -> NDArray[np.float64]:
    """A pixel of the viewport, most likely on the body."""
    seen = aim(hands)
    middle, size = np.nan_to_num(seen.pixel(hands.session.region.centre)), np.array(seen.size)
    return np.clip(middle + 0.12 * size.min() * chance.standard_normal(2), 60, size - 60)


def _one(chance: Generator, choices: Sequence[int]) -> int:
    return choices[int(chance.integers(len(choices)))]
