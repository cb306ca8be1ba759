"""A few random gestures in the real window; a thousand are made by `make reliability`."""

from __future__ import annotations

from .drive import Hands
from .stirring import stir


def random_gestures(hands: Hands) -> None:
    """Nothing fails, what is saved looks the same when it is opened again, and all can be undone."""
    told = stir(hands, gestures=14, every=14, seed=1)
    assert told["steps"] > 4, told
