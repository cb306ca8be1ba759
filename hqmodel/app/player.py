"""Plays an animation over the scene: what is shown changes, the scene itself does not, and stopping puts everything back."""

from __future__ import annotations

from hqmodel.edit.animation import Animation, filmed, staged
from hqmodel.model import Camera, Scene


class Player:
    """At most one animation, running or held at a moment: `share` is how much of its round has passed, from 0 to 1."""

    def __init__(self) -> None:
        self.animation: Animation | None = None
        self.running = False
        self.share = 0.0
        self._advanced: float | None = None
        self._staged: tuple[Scene, Animation, float, Scene] | None = None

    def play(self, animation: Animation, share: float | None = None, running: bool = True) -> None:
        """From a moment on, by default the one that it is at; or just show that moment."""
        self.animation, self.running, self._advanced = animation, running, None
        self.share = self.share if share is None else share

    def stop(self) -> None:
        """The scene is shown as it is."""
        self.animation, self.running, self.share = None, False, 0.0

    def advance(self, now: float) -> None:
        """So late is it, in seconds of any clock."""
        if self.animation is None or not self.running:
            return
        passed = 0.0 if self._advanced is None else (now - self._advanced) / self.animation.duration
        self._advanced = now
        if self.animation.repeat == "once" and self.share + passed >= 1:
            self.share, self.running = 1.0, False
        else:
            self.share = (self.share + passed) % 1

    def scene(self, scene: Scene) -> Scene:
        """The scene as it is to be shown; EditError where the animation can't be applied to it (any more)."""
        if self.animation is None:
            return scene
        known = self._staged
        if known is None or known[0] is not scene or known[1:3] != (self.animation, self.share):
            known = scene, self.animation, self.share, staged(scene, self.animation, self.animation.phase(self.share))
            self._staged = known
        return known[3]

    def camera(self, camera: Camera) -> Camera:
        """The camera as it is to be looked through."""
        return camera if self.animation is None else filmed(camera, self.animation, self.animation.phase(self.share))
