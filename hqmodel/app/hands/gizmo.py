"""ImGuizmo on the selected shapes, and the cube in the corner that turns the view."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import asin, atan2, degrees

import numpy as np
from imgui_bundle import imgui, imguizmo
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from hqmodel import edit
from hqmodel.model import Camera, Scene, vector

from ..intents import Grab, Intent, Look, Release, Show
from ..session import Session
from ..theme import enlarged
from ..tools.aim import Aim
from ..tools.arranging import SCALE_STEP, TURN_STEP, Move
from ..tools.reach import pivot

guizmo = imguizmo.im_guizmo
Array = NDArray[np.float64]
_OPERATIONS = {
    "move": guizmo.OPERATION.translate,
    "turn": guizmo.OPERATION.rotate,
    "scale": guizmo.OPERATION.scale,
}
# What ImGuizmo itself snaps to; moves go onto the grid.
_STEPS = {"turn": TURN_STEP, "scale": SCALE_STEP}
_LABELS = {"move": "Move", "turn": "Turn", "scale": "Scale"}
# The cube's side in heights of the font, and its distance from the corner.
_CUBE, _INSET = 5.5, 0.4
# The gizmo's arrows, as a share of the viewport.
_SIZE = 0.2
# Of its lines and what they end with, in pixels of a usual screen.
_WIDTHS = {
    "translation_line_thickness": 3.0,
    "translation_line_arrow_size": 6.0,
    "rotation_line_thickness": 2.0,
    "rotation_outer_line_thickness": 3.0,
    "scale_line_thickness": 3.0,
    "scale_line_circle_size": 6.0,
    "hatched_axis_line_thickness": 6.0,
    "center_circle_size": 6.0,
}


@dataclass
class Gizmo:
    """What is being moved by it: the scene and the pivot it began with, and its matrix as ImGuizmo has it now.

    `shown`: whether it was, in the last frame; ImGuizmo itself goes on to claim the mouse where one was.
    """

    before: Scene | None = None
    pivot: tuple[float, float, float] = (0.0, 0.0, 0.0)
    matrix: Array | None = None
    shown: bool = False

    @property
    def busy(self) -> bool:
        """Whether the mouse is its own."""
        ours = self.shown and (guizmo.is_using() or guizmo.is_over())
        return ours or guizmo.is_using_view_manipulate() or guizmo.is_view_manipulate_hovered()

    def draw(self, session: Session, aim: Aim, corner: imgui.ImVec2) -> list[Intent]:
        """The gizmo of the tool in hand, where shapes are selected."""
        tool, chosen = session.kit.tool, session.selection.shapes
        self.shown = tool in _OPERATIONS and bool(chosen) and session.held is None
        if not self.shown:
            self.before = self.matrix = None
            return []
        view, projection = _matrices(session, aim)
        guizmo.begin_frame()
        guizmo.set_drawlist()
        guizmo.set_rect(corner.x, corner.y, *map(float, aim.size))
        guizmo.set_orthographic(aim.camera.orthographic)
        guizmo.set_gizmo_size_clip_space(_SIZE)
        for name, width in _WIDTHS.items():
            setattr(guizmo.get_style(), name, width * enlarged(session.preferences.percent))
        start = np.eye(4)
        start[:3, 3] = pivot(session.scene, chosen) if self.before is None else self.pivot
        held = start if self.matrix is None else self.matrix
        matrix = _matrix16(held)
        snap = guizmo.Matrix3([_STEPS[tool]] * 3) if imgui.get_io().key_ctrl and tool in _STEPS else None
        guizmo.manipulate(view, projection, _OPERATIONS[tool], guizmo.MODE.world, matrix, None, snap)
        if not guizmo.is_using():
            ended, self.before, self.matrix = self.before is not None, None, None
            return [Release()] if ended else []
        after = _array(matrix)
        self.matrix = after if np.all(np.isfinite(after)) else held  # it has no answer where it is pulled along the view
        intents: list[Intent] = []
        if self.before is None:
            self.before, self.pivot = session.scene, vector(start[:3, 3])
            intents.append(Grab((), _LABELS[tool]))
        return [*intents, Show(self._arranged(self.before, tool, chosen, aim))]

    def _arranged(self, before: Scene, tool: str, chosen: tuple[int, ...], aim: Aim) -> Scene:
        """The scene that the matrix stands for."""
        assert self.matrix is not None
        linear = self.matrix[:3, :3]
        if tool == "move":
            move, by = Move(before, aim, chosen, self.pivot, (0.0, 0.0)), vector(self.matrix[:3, 3] - self.pivot)
            return move.scene(move.snapped(by) if imgui.get_io().key_ctrl else by)
        if tool == "turn":
            x, y, z, w = Rotation.from_matrix(linear / np.linalg.norm(linear, axis=0)).as_quat()
            return edit.turn_shapes(before, chosen, (float(x), float(y), float(z), float(w)), self.pivot)
        factors = np.maximum(np.linalg.norm(linear, axis=0), 1e-3)
        for axis, factor in zip(np.eye(3), factors, strict=True):
            if factor != 1.0:
                before = edit.stretch_shapes(before, chosen, axis, float(factor), self.pivot)
        return before


def cube(session: Session, aim: Aim, corner: imgui.ImVec2) -> list[Intent]:
    """The view cube in the viewport's upper right: dragged or clicked, it turns the camera."""
    em = imgui.get_font_size()
    side = _CUBE * em
    view, _ = _matrices(session, aim)
    at = imgui.ImVec2(corner.x + aim.size[0] - side - _INSET * em, corner.y + _INSET * em)
    before = _array(view)
    guizmo.set_drawlist()
    guizmo.view_manipulate(view, aim.camera.distance, at, imgui.ImVec2(side, side), 0)
    after = _array(view)
    if not np.all(np.isfinite(after)) or np.allclose(before, after, atol=1e-5):
        return []
    return [Look(_seen_along(aim.camera, after[2, :3]))]


def _seen_along(camera: Camera, back: Array) -> Camera:
    """The camera turned so that this direction points at it."""
    x, y, z = back / np.linalg.norm(back)
    elevation = degrees(asin(min(1.0, max(-1.0, z))))
    azimuth = camera.azimuth if abs(elevation) > 89.0 else degrees(atan2(x, -y)) % 360.0
    return replace(camera, azimuth=float(azimuth), elevation=float(elevation))


def _matrices(session: Session, aim: Aim) -> tuple[guizmo.Matrix16, guizmo.Matrix16]:
    camera = aim.camera
    reach = camera.distance + float(np.linalg.norm(session.shown_region.size))
    near, far = (-reach, reach) if camera.orthographic else (1e-3 * camera.distance, 2 * reach)
    return _matrix16(camera.view_matrix()), _matrix16(camera.projection_matrix(aim.size[0] / aim.size[1], near, far))


def _matrix16(matrix: Array) -> guizmo.Matrix16:
    """ImGuizmo's matrices are column by column."""
    return guizmo.Matrix16(matrix.T.ravel().tolist())


def _array(matrix: guizmo.Matrix16) -> Array:
    return np.array(matrix.values, dtype=float).reshape(4, 4).T
