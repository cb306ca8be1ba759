"""Undo and redo as a list of scenes, with no window in it."""

from __future__ import annotations

from dataclasses import dataclass, field

from hqmodel.model import Scene


@dataclass
class History:
    """The scene being edited and how it came to be; `present` is what to show.

    The batching rules:

    - `apply` is one step; where it changes nothing there is none.
    - A drag is `begin`, any number of `preview`, then `commit` (one step, or none where nothing changed) or `cancel`
      (everything as it was at `begin`).
    - Whatever else happens during a drag ends it: `apply` and another `begin` commit it first; `undo` takes the drag itself back.
    - A new step forgets what was undone.

    Scenes are values that share what they have in common, so any number of steps is kept.
    """

    present: Scene
    _undone: list[tuple[str, Scene]] = field(default_factory=list, init=False, repr=False)
    _done: list[tuple[str, Scene]] = field(default_factory=list, init=False, repr=False)
    _drag: tuple[str, Scene] | None = field(default=None, init=False, repr=False)
    _saved: Scene | None = field(default=None, init=False, repr=False)

    def __post_init__(self) -> None:
        self._saved = self.present

    @property
    def can_undo(self) -> bool:
        return bool(self._done) or self.dragging

    @property
    def can_redo(self) -> bool:
        return bool(self._undone) and not self.dragging

    @property
    def undo_label(self) -> str:
        """What `undo` would take back; empty where there is nothing."""
        if self._drag:
            return self._drag[0]
        return self._done[-1][0] if self._done else ""

    @property
    def redo_label(self) -> str:
        """What `redo` would do again; empty where there is nothing."""
        return self._undone[-1][0] if self.can_redo else ""

    @property
    def labels(self) -> list[str]:
        """The steps done so far, the oldest first."""
        return [label for label, _ in self._done]

    @property
    def dragging(self) -> bool:
        return self._drag is not None

    @property
    def dirty(self) -> bool:
        """Whether the scene differs from what was last saved or opened."""
        return self.present is not self._saved and self.present != self._saved

    def mark_saved(self) -> None:
        """The present scene is what the file holds."""
        self._saved = self.present

    def mark_unsaved(self) -> None:
        """No file holds the present scene (recovered work, say)."""
        self._saved = None

    def apply(self, scene: Scene, label: str) -> None:
        """Make one step to another scene."""
        self.commit()
        self._step(label, self.present, scene)

    def begin(self, label: str) -> None:
        """Start a drag from the present scene."""
        self.commit()
        self._drag = label, self.present

    def preview(self, scene: Scene) -> None:
        """Show the scene as the drag has it now; RuntimeError outside a drag."""
        if self._drag is None:
            raise RuntimeError("preview() belongs between begin() and commit()")
        self.present = scene

    def commit(self) -> None:
        """End the drag, if there is one, as a single step."""
        if self._drag is not None:
            (label, before), self._drag = self._drag, None
            self._step(label, before, self.present)

    def cancel(self) -> None:
        """End the drag, if there is one, and put everything back."""
        if self._drag is not None:
            (_, self.present), self._drag = self._drag, None

    def undo(self) -> Scene:
        """Take the last step back, or the drag in progress; the scene to show now."""
        if self._drag is not None:
            self.cancel()
        elif self._done:
            label, before = self._done.pop()
            self._undone.append((label, self.present))
            self.present = before
        return self.present

    def redo(self) -> Scene:
        """Do the last undone step again; the scene to show now."""
        if self.can_redo:
            label, after = self._undone.pop()
            self._done.append((label, self.present))
            self.present = after
        return self.present

    def _step(self, label: str, before: Scene, after: Scene) -> None:
        if after is before or after == before:  # no step, and not another scene that only looks the same
            self.present = before
            return
        self.present = after
        self._done.append((label, before))
        self._undone.clear()
