"""From the field to curves in a plane, and curves to drawings."""

from hqmodel.field import Plane

from .drawings import ENDINGS, write
from .outline import Outline, OutlineError, outline

__all__ = ["ENDINGS", "Outline", "OutlineError", "Plane", "outline", "write"]
