"""The mathematics in NumPy float64: the field, its derivatives, exact bounds, the body's box and ray roots."""

from .colors import linear_to_srgb, mixed_colors, srgb_to_linear
from .evaluate import (
    Curvature,
    curvature,
    gradient,
    log_gradient,
    log_ratio,
    near_linear,
    near_linear_gradient,
    near_linear_single,
    shaping_strip,
    term_weights,
    value,
)
from .intervals import box_bounds, relevant_terms, segment_bounds
from .rays import first_hits
from .region import Region, reaches, region
from .symmetry import mirror_axes
from .terms import Terms

__all__ = [
    "Curvature",
    "Region",
    "Terms",
    "box_bounds",
    "curvature",
    "first_hits",
    "gradient",
    "linear_to_srgb",
    "log_gradient",
    "log_ratio",
    "mirror_axes",
    "mixed_colors",
    "near_linear",
    "near_linear_gradient",
    "near_linear_single",
    "reaches",
    "region",
    "relevant_terms",
    "segment_bounds",
    "shaping_strip",
    "srgb_to_linear",
    "term_weights",
    "value",
]
