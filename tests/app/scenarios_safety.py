"""Saving and recovering in the real window. Each function is one visit, in a process of its own."""

from __future__ import annotations

from imgui_bundle import imgui

from hqmodel import files
from hqmodel.app import filing
from hqmodel.app.asks import Overwrite, Recover
from hqmodel.edit import new_scene

from .drive import Hands
from .scenarios import CTRL, title


def after_a_crash(hands: Hands) -> None:
    """What two windows left is offered: one is thrown away, one goes on, and saving finds its file changed meanwhile."""
    session, path = hands.session, hands.folder / "clay.json"
    files.save(new_scene(), path)
    for name, file in (("egg", None), ("clay", str(path))):
        ring = files.Ring()
        ring.keep(session.scene.changed(level=0.5), files.Origin(name, file, "what it held then"))
        ring.abandon()
    filing.offer(session, files.lost())
    hands.settle()
    asked = session.dialogs[-1]
    assert isinstance(asked, Recover)
    hands.shoot("recover")
    names = [lost.origin.name for lost in asked.lost]
    hands.click(f"//Unsaved Work Found/**/$${names.index('egg')}/Discard")
    hands.click("//Unsaved Work Found/**/$$0/Open")
    assert not session.dialogs
    assert title(hands) == "clay* - hqmodel"
    assert session.scene.level == 0.5
    hands.keys(CTRL | imgui.Key.s)
    assert isinstance(session.dialogs[-1], Overwrite)
    hands.shoot("overwrite")
    hands.click("//Changed Meanwhile/Overwrite")
    assert title(hands) == "clay - hqmodel"
    assert files.load(path).level == 0.5
    hands.menu("File/###versions")
    hands.shoot("versions")
    assert len(list(files.backup_folder(path).iterdir())) == 1
    hands.click("//Open/Cancel")
