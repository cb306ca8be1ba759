"""Films: a scene in motion drawn off screen, frame by frame, and written as a GIF, as numbered pictures or as MP4."""

from .shooting import Plan, shoot
from .writing import ENDINGS, FilmError, NoWriter, check

__all__ = ["ENDINGS", "FilmError", "NoWriter", "Plan", "check", "shoot"]
