"""The landscape of a flat scene: its sum of exponentials as hills over the plane, and the level plane that cuts the body out.

The figures 16 to 18 of Hanson 1988, to be turned, and the level to be dragged up and down.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from imgui_bundle import imgui, implot3d
from numpy.typing import NDArray

from hqmodel.field import Landscape, Terms, landscape, mixed_colors
from hqmodel.model import FIELDS, Scene, Shape

from ..form import Form, Memory
from ..intents import Grab, Intent, Put
from ..session import Session
from ..theme import ACCENT

Array = NDArray[np.float64]

_SQUARES = 64
# Land further than this from 0 is cut off, or further than twice the level; a lone shape with its constant at 1 has the level 1.
_TALLEST = 4.0
# How much higher than wide the land is drawn, what a pixel turns it by in degrees, and where it is seen from at first.
_STEEP, _RATE, _ELEVATION, _AZIMUTH = 0.8, 0.4, 30.0, -60.0
# How much of the panel the land takes.
_SIZE = 1.4
_GROUND = 0.62
_LIGHT = np.array([-0.45, -0.35, 0.82])
_PLANE, _CURVE = (0.35, 0.5, 0.72, 0.35), (1.0, 1.0, 1.0, 1.0)
_LEVEL = ("level",)
_FLAT_ONLY = (
    "A landscape has a plane to stand on: it is there for flat scenes (Dimension in the Scene panel), and this one is solid."
)


@dataclass
class Ground:
    """What the panel remembers: the land and its colours, worked out once for the shapes, and where it is seen from."""

    land: Landscape | None = None
    colors: NDArray[np.uint32] = field(default_factory=lambda: np.empty(0, dtype=np.uint32))
    height: tuple[float, float] = 0.0, 1.0
    elevation: float = _ELEVATION
    azimuth: float = _AZIMUTH
    _shapes: tuple[Shape, ...] = ()
    _slice: float = 0.0

    def under(self, scene: Scene) -> Landscape:
        """The land of a scene, no higher and no deeper than is shown; the level does not change it."""
        if self.land is None or (scene.shapes, scene.slice) != (self._shapes, self._slice):
            self._shapes, self._slice = scene.shapes, scene.slice
            found, tallest = landscape(scene, _SQUARES), max(_TALLEST, 2 * abs(scene.level))
            cut = np.clip(found.heights, -tallest, tallest)
            self.land = Landscape(np.concatenate([found.points[..., :2], cut[..., None]], axis=-1))
            self.height = min(0.0, float(cut.min())), max(float(cut.max()), 1e-3)
            self.colors = _colors(scene, self.land, self.height)
        return self.land


def draw(session: Session, memory: Memory, ground: Ground) -> list[Intent]:
    """The level's slider, and the landscape below it, to be turned; the level plane by its knob."""
    if session.scene.dimension == 3:
        imgui.text_wrapped(_FLAT_ONLY)
        return []
    form = Form(session.scene, memory)
    form.number(_LEVEL)
    scene, size = session.shown, imgui.get_content_region_avail()
    if min(size.x, size.y) < 4 * imgui.get_font_size():
        return form.intents
    corner = imgui.get_cursor_screen_pos()
    foot, top = _plotted(ground, scene, size)
    return form.intents + _handled(session.scene, ground, size, corner, foot, top)


def _plotted(ground: Ground, scene: Scene, size: imgui.ImVec2) -> tuple[Array, Array]:
    """Draw the land, the plane and its curve; the ends of the pole that the knob slides on, in pixels of the screen."""
    land, (bottom, top) = ground.under(scene), ground.height
    level = min(max(scene.level, bottom), top)
    if implot3d.get_current_context() is None:
        implot3d.create_context()
    flags = implot3d.Flags_.canvas_only | implot3d.Flags_.no_inputs
    if not implot3d.begin_plot("##land", size, flags):
        return np.zeros(2), np.zeros(2)
    bare = implot3d.AxisFlags_.no_decorations
    implot3d.setup_axes("x", "y", "w", bare, bare, bare)
    (low_x, low_y), (high_x, high_y) = land.low, land.high
    implot3d.setup_axes_limits(low_x, high_x, low_y, high_y, bottom, top, implot3d.Cond_.always)
    unit = _SIZE / max(high_x - low_x, high_y - low_y)
    implot3d.setup_box_scale(unit * (high_x - low_x), unit * (high_y - low_y), _SIZE * _STEEP)
    implot3d.setup_box_rotation(ground.elevation, ground.azimuth, False, implot3d.Cond_.always)
    spec = implot3d.Spec(flags=implot3d.SurfaceFlags_.no_lines)
    spec.fill_colors = ground.colors
    _surface("land", land.points, spec)
    plane = land.points.copy()
    plane[..., 2] = level
    _surface("level", plane, implot3d.Spec(fill_color=_PLANE, flags=implot3d.SurfaceFlags_.no_lines))
    curve = land.section(level).reshape(-1, 3)
    if len(curve):
        spec = implot3d.Spec(line_color=_CURVE, line_weight=2.5, flags=implot3d.LineFlags_.segments)
        x, y, z = np.ascontiguousarray(curve.T)
        implot3d.plot_line("section", x, y, z, spec)
    corners = land.points[[0, -1, -1, 0], [0, 0, -1, -1], :2]
    poles = [[implot3d.plot_to_pixels(x, y, height) for height in (bottom, top)] for x, y in corners.tolist()]
    implot3d.end_plot()
    foot, head = max(poles, key=lambda pole: pole[0].x)
    return np.array([foot.x, foot.y]), np.array([head.x, head.y])


def _handled(scene: Scene, ground: Ground, size: imgui.ImVec2, corner: imgui.ImVec2, foot: Array, top: Array) -> list[Intent]:
    """A drag anywhere turns the land; one at the knob, on its pole from foot to top (2,), moves the level, in one undo step."""
    imgui.set_cursor_screen_pos(corner)
    imgui.set_next_item_allow_overlap()
    imgui.invisible_button("##turn", size)
    moved = imgui.get_io().mouse_delta
    if imgui.is_item_active():
        ground.azimuth += _RATE * moved.x
        ground.elevation = min(max(ground.elevation + _RATE * moved.y, 0.0), 90.0)
    low, high = ground.height
    pole, radius = top - foot, 0.5 * imgui.get_font_size()
    share = min(max((scene.level - low) / (high - low), 0.0), 1.0)
    knob = foot + share * pole
    imgui.set_cursor_screen_pos((knob[0] - 1.5 * radius, knob[1] - 1.5 * radius))
    imgui.invisible_button("##knob", (3 * radius, 3 * radius))
    intents: list[Intent] = [Grab(_LEVEL, FIELDS["level"].label)] if imgui.is_item_activated() else []
    active, length = imgui.is_item_active(), float(pole @ pole)
    if not active:
        imgui.set_item_tooltip("Drag the level plane up or down")
    pen = imgui.get_window_draw_list()
    pen.add_line(tuple(foot), tuple(top), imgui.get_color_u32((*ACCENT[:3], 0.5)), 2.0)
    swollen = 1.2 if active or imgui.is_item_hovered() else 1.0
    pen.add_circle_filled(tuple(knob), radius * swollen, imgui.get_color_u32(ACCENT))
    if active and length > 0 and (moved.x or moved.y):
        share = min(max(share + float(pole @ (moved.x, moved.y)) / length, 0.0), 1.0)
        intents.append(Put(_LEVEL, round(low + (high - low) * share, 4), FIELDS["level"].label))
    return intents


def _surface(name: str, points: Array, spec: implot3d.Spec) -> None:
    x, y, z = np.ascontiguousarray(points.reshape(-1, 3).T)
    implot3d.plot_surface(name, x, y, z, len(points), len(points), 0.0, 0.0, spec)


def _colors(scene: Scene, land: Landscape, height: tuple[float, float]) -> NDArray[np.uint32]:
    """ImGui's colours of the land's points: their shapes' colours, by daylight."""
    risen = np.minimum(4 * np.abs(land.heights[..., None]) / max(height[1], -height[0]), 1.0)
    own = mixed_colors(scene, Terms.of(scene), land.points * [1, 1, 0]) * risen + _GROUND * (1 - risen)
    x, y = land.points[:, 0, 0], land.points[0, :, 1]
    steep = _STEEP * float(np.max(land.high - land.low)) / (height[1] - height[0])
    along_x, along_y = np.gradient(land.heights * steep, x, y)
    normal = np.stack([-along_x, -along_y, np.ones_like(along_x)], axis=-1)
    light = np.maximum(normal @ _LIGHT / np.linalg.norm(normal, axis=-1) / np.linalg.norm(_LIGHT), 0.0)
    shaded = np.clip(own * (0.4 + 0.7 * light[..., None]) * 255, 0, 255).astype(np.uint32)
    return (0xFF000000 | shaded[..., 2] << 16 | shaded[..., 1] << 8 | shaded[..., 0]).ravel()
