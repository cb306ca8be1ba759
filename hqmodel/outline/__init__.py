"""From the field to curves in a plane, and curves to drawings."""

from .drawings import ENDINGS, write
from .outline import Outline, OutlineError, outline
from .plane import Plane

__all__ = ["ENDINGS", "Outline", "OutlineError", "Plane", "outline", "write"]
