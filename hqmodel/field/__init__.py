"""The mathematics in NumPy float64: the field, its derivatives, exact bounds, the body's box and ray roots."""

from .colors import linear_to_srgb, mixed_colors, srgb_to_linear
from .evaluate import (
    Curvature,
    curvature,
    gradient,
    lattice_log_ratio,
    log_gradient,
    log_ratio,
    shaping_strip,
    term_weights,
    value,
)
from .faces import Face, face, image_at
from .frames import PLANES, frame_residual, nearest_frame, slice_range, turned_frame
from .generators import FEWEST_TERMS, FRAMES, SOLIDS, make_frame
from .intervals import box_bounds, relevant_terms, segment_bounds
from .landscape import Landscape, landscape
from .lines import bounding_lines
from .plane import Plane
from .radial import RadialSolution, approximate_radii, radial_solution
from .rays import first_hits
from .region import Region, reaches, region, sharing
from .solvers import Evolved, Lattice, lattice_search, normal_evolution
from .starlike import NotStarShaped, star_centre
from .straight import near_linear, near_linear_gradient, near_linear_single
from .symmetry import mirror_axes
from .terms import Terms, images, rotation_matrix, world_planes

__all__ = [
    "FEWEST_TERMS",
    "FRAMES",
    "PLANES",
    "SOLIDS",
    "Curvature",
    "Evolved",
    "Face",
    "Landscape",
    "Lattice",
    "NotStarShaped",
    "Plane",
    "RadialSolution",
    "Region",
    "Terms",
    "approximate_radii",
    "bounding_lines",
    "box_bounds",
    "curvature",
    "face",
    "first_hits",
    "frame_residual",
    "gradient",
    "image_at",
    "images",
    "landscape",
    "lattice_log_ratio",
    "lattice_search",
    "linear_to_srgb",
    "log_gradient",
    "log_ratio",
    "make_frame",
    "mirror_axes",
    "mixed_colors",
    "near_linear",
    "near_linear_gradient",
    "near_linear_single",
    "nearest_frame",
    "normal_evolution",
    "radial_solution",
    "reaches",
    "region",
    "relevant_terms",
    "rotation_matrix",
    "segment_bounds",
    "shaping_strip",
    "sharing",
    "slice_range",
    "srgb_to_linear",
    "star_centre",
    "term_weights",
    "turned_frame",
    "value",
    "world_planes",
]
