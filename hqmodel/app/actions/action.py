"""What an action is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..session import Session


def always(_: Session) -> bool:
    return True


def _nothing(_: Session) -> str:
    return ""


@dataclass(frozen=True)
class Action:
    """One thing that can be done. `shortcuts` are written as people write them, Ctrl+Shift+S; the menu shows the first.

    `detail` is added to the label: what would be undone, for one.
    """

    label: str
    run: Callable[[Session], None]
    shortcuts: tuple[str, ...] = ()
    enabled: Callable[[Session], bool] = always
    checked: Callable[[Session], bool] | None = None
    detail: Callable[[Session], str] = _nothing

    def title(self, session: Session) -> str:
        detail = self.detail(session)
        return f"{self.label} {detail}" if detail else self.label
