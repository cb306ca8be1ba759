"""The scene on the GPU: its layout in GPU memory, the shaders put together, the preview off screen and in the window."""

from .context import GpuError, offscreen
from .preview import MODES, Preview

__all__ = ["MODES", "GpuError", "Preview", "offscreen"]
