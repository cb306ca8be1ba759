"""The scene on the GPU: its layout in GPU memory, the shaders put together, the preview off screen and in the window."""

from .assembly import ShaderError
from .context import GpuError, offscreen
from .legend import Legend, with_legend
from .modes import MODES
from .preview import Preview, Seen
from .still import render
from .tables import field_values, raycast

__all__ = [
    "MODES",
    "GpuError",
    "Legend",
    "Preview",
    "Seen",
    "ShaderError",
    "field_values",
    "offscreen",
    "raycast",
    "render",
    "with_legend",
]
