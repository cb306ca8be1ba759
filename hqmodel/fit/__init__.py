"""From points or a mesh to a scene of hyperquadrics.

The package itself can be called, as its `fit` can: `hqmodel.fit(points)` does not depend on what was imported before.
"""

import sys
from types import ModuleType

from .cloud import FitError
from .fitting import MOST_PARTS, MOST_STRIPS, Fit, Report, fit
from .read import FORMATS, Read, read

__all__ = ["FORMATS", "MOST_PARTS", "MOST_STRIPS", "Fit", "FitError", "Read", "Report", "fit", "read"]


class _Callable(ModuleType):
    __call__ = staticmethod(fit)


sys.modules[__name__].__class__ = _Callable
