"""What is drawn over the picture: the face under the hand, the handles, the line of a cut, and the numbers of a gesture."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from ..session import Session
from ..theme import ACCENT
from ..tools.aim import Aim
from ..tools.grip import Grip
from ..tools.handles import Handles
from ..tools.kit import TOUCHING
from ..tools.sculpting import Chop, Push, Tilt
from .hand import Hand, known_handles

Color = tuple[float, float, float, float]
LIT: Color = (1.0, 0.82, 0.45, 1.0)
WHITE: Color = (1.0, 1.0, 1.0, 0.95)
SHADE: Color = (0.0, 0.0, 0.0, 0.55)


class Pen:
    """Draws on the window's list in pixels of the viewport, which is so large (width, height); lines as wide as on a usual
    screen, whose pixels are so large here."""

    def __init__(self, corner: imgui.ImVec2, size: tuple[int, int], pixel: float) -> None:
        self._list = imgui.get_window_draw_list()
        self._corner, self._size, self._pixel = corner, size, pixel
        self.em = imgui.get_font_size()

    def line(self, points: NDArray[np.float64], color: Color, width: float = 1.5, closed: bool = False) -> None:
        """A line through pixels (n, 2); parts behind the eye (NaN) are left out."""
        ends = np.vstack([points, points[:1]]) if closed else points
        for a, b in pairwise(ends):
            if np.all(np.isfinite(a)) and np.all(np.isfinite(b)):
                self._list.add_line(self._at(a), self._at(b), imgui.get_color_u32(color), width * self._pixel)

    def area(self, points: NDArray[np.float64], color: Color) -> None:
        """A convex polygon (n, 2)."""
        if len(points) > 2 and np.all(np.isfinite(points)):
            self._list.add_convex_poly_filled([self._at(point) for point in points], imgui.get_color_u32(color))

    def dots(self, points: NDArray[np.float64], color: Color) -> None:
        """A small square at each pixel (n, 2)."""
        ink, half = imgui.get_color_u32(color), self._pixel
        left, top = self._corner.x, self._corner.y
        for x, y in points.tolist():
            self._list.add_rect_filled((left + x - half, top + y - half), (left + x + half, top + y + half), ink)

    def shaded(self, low: tuple[float, float], high: tuple[float, float], top: Sequence[int], bottom: Sequence[int]) -> None:
        """A rectangle from its upper left to its lower right pixel, from one sRGB colour (0 to 255) to another downwards."""
        above, below = (imgui.get_color_u32((r / 255, g / 255, b / 255, 1.0)) for r, g, b in (top, bottom))
        self._list.add_rect_filled_multi_color(self._at(np.array(low)), self._at(np.array(high)), above, above, below, below)

    def text(self, at: Iterable[float], text: str) -> None:
        """A line of text on a plate, its left end there, or as far to the left and up as it takes to be seen whole."""
        size, pad = imgui.calc_text_size(text), 0.35 * self.em
        room = np.array([self._size[0] - size.x - pad, self._size[1] - size.y - pad])
        low = self._at(np.maximum(np.minimum(tuple(at), room), pad))
        self._list.add_rect_filled(
            (low.x - pad, low.y - pad), (low.x + size.x + pad, low.y + size.y + pad), imgui.get_color_u32(SHADE), pad
        )
        self._list.add_text(low, imgui.get_color_u32(WHITE), text)

    def _at(self, pixel: NDArray[np.float64]) -> imgui.ImVec2:
        return imgui.ImVec2(self._corner.x + float(pixel[0]), self._corner.y + float(pixel[1]))


def draw(session: Session, hand: Hand, aim: Aim, pen: Pen) -> None:
    """All that the hand needs over the picture in this frame."""
    known = known_handles(session, aim)
    held, hand.lit = session.held, None
    if held is None:
        if hand.boxing and hand.moved:
            _box(pen, hand)
        if (grip := _shown_grip(session, hand, known)) is not None:
            hand.lit = grip.shape, grip.strip
            _face(pen, session, aim, grip, LIT)
            pen.text((hand.at[0] + pen.em, hand.at[1] + 1.4 * pen.em), named(session, grip))
        if known is not None:
            _handles(pen, known, aim, known.at(hand.at))
        return
    gesture = held.gesture
    if isinstance(gesture, (Push, Tilt)):
        grip = gesture.grip
        if len(session.scene.shapes[grip.shape].strips) == len(gesture.before.shapes[grip.shape].strips):
            _face(pen, session, aim, grip, LIT)
    if isinstance(gesture, Chop):
        start = np.array(gesture.start)
        pen.line(np.array([start, start + held.values]), LIT, 2.0)
    pen.text((hand.at[0] + pen.em, hand.at[1] + 1.4 * pen.em), held.told(session.scene))


def named(session: Session, grip: Grip) -> str:
    """The strip under the hand, its half-width and its exponent."""
    shape = session.scene.shapes[grip.shape]
    strip = shape.strips[grip.strip]
    side = "+" if grip.side > 0 else "-"
    return (
        f"{shape.name or 'shape'}, strip {grip.strip + 1} {side}   half-width {strip.half_width:.3g}   exponent {strip.gamma:.3g}"
    )


def _shown_grip(session: Session, hand: Hand, known: Handles | None) -> Grip | None:
    """The face that would be taken hold of: not while the view is turned, and not under a handle."""
    if session.kit.tool not in TOUCHING or (hand.button is not None and hand.taking is None):
        return None
    return None if known is not None and known.at(hand.at) else hand.grip(session.scene)


def _face(pen: Pen, session: Session, aim: Aim, grip: Grip, color: Color) -> None:
    """The bounding plane as the polygon that it has in the polytope."""
    polygon = grip.face(session.scene).polygon
    if len(polygon):
        seen = aim.pixel(polygon)
        pen.area(seen, (*color[:3], 0.10))
        pen.line(seen, SHADE, 3.0, closed=True)
        pen.line(seen, color, 1.5, closed=True)


def _handles(pen: Pen, known: Handles, aim: Aim, part: str | None) -> None:
    """Arrow, ring and diamond; the one under the pointer is lit."""
    colors = {name: LIT if part == name else ACCENT for name in ("push", "tilt", "exponent")}
    if len(known.face.polygon):
        pen.line(aim.pixel(known.face.polygon), (*ACCENT[:3], 0.8), 1.5, closed=True)
    size = known.scale
    pen.line(known.ring, SHADE, 4.0, closed=True)
    pen.line(known.ring, colors["tilt"], 2.0, closed=True)
    start, tip = known.arrow
    pen.line(known.arrow, SHADE, 5.0)
    pen.line(known.arrow, colors["push"], 3.0)
    along = (tip - start) / max(float(np.hypot(*(tip - start))), 1e-6)
    aside = np.array([-along[1], along[0]])
    pen.area(np.array([tip + 9 * size * along, tip + 6 * size * aside, tip - 6 * size * aside]), colors["push"])
    diamond = known.middle + 7 * size * np.array([(1, 0), (0, 1), (-1, 0), (0, -1)])
    pen.area(diamond, colors["exponent"])
    pen.line(diamond, SHADE, 1.5, closed=True)


def _box(pen: Pen, hand: Hand) -> None:
    (x, y), (u, v) = hand.pressed, hand.at
    corners = np.array([(x, y), (u, y), (u, v), (x, v)])
    pen.area(corners, (*LIT[:3], 0.08))
    pen.line(corners, LIT, 1.5, closed=True)
