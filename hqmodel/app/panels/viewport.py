"""The viewport: the body's picture, with the hands and their tools over it."""

from __future__ import annotations

from imgui_bundle import imgui

from ..hands import bands, cloud, gizmo, grid, legend, overlay, toolbar
from ..hands.hand import Hand, Picture, free
from ..hands.holding import holding
from ..intents import Intent, Resize
from ..session import Session
from ..theme import enlarged
from ..tools.aim import Aim

_ANY = imgui.ButtonFlags_.mouse_button_left | imgui.ButtonFlags_.mouse_button_middle | imgui.ButtonFlags_.mouse_button_right


def draw(session: Session, hand: Hand, picture: Picture) -> list[Intent]:
    """The picture, in as many pixels as there is room for, and all that can be done in it."""
    room, scale = imgui.get_content_region_avail(), imgui.get_io().display_framebuffer_scale
    points = max(1, int(room.x)), max(1, int(room.y))
    size = max(1, round(points[0] * scale.x)), max(1, round(points[1] * scale.y))
    corner = imgui.get_cursor_screen_pos()
    imgui.image(imgui.ImTextureRef(picture.draw(size)), points, (0, 1), (1, 0))
    imgui.set_cursor_screen_pos(corner)
    intents: list[Intent] = [] if size == session.size else [Resize(size)]
    aim = Aim(session.view.camera, points, session.preferences.grid_step)
    if not hand.gizmo.busy or hand.button is not None:  # ImGuizmo takes no click that an item could take
        imgui.invisible_button("view", points, _ANY | imgui.ButtonFlags_.allow_overlap)
        imgui.set_item_key_owner(imgui.Key.mouse_wheel_y)
        imgui.set_item_key_owner(imgui.Key.mouse_wheel_x)
        intents += holding(hand, session.held) if session.held else free(session, hand, picture, aim, corner)
    pen = overlay.Pen(corner, points, enlarged(session.preferences.percent))
    if session.cloud is not None and not session.cloud_hidden:
        cloud.draw(pen, aim, session.cloud)
    grid.draw(session, aim, pen)
    bands.draw(session, aim, pen)
    overlay.draw(session, hand, aim, pen)
    if session.view.mode == "curvature":
        legend.scale(pen, picture.legend, points)
    intents += hand.gizmo.draw(session, aim, corner) + gizmo.cube(session, aim, corner)
    intents += toolbar.draw(session, corner) + legend.section(session, corner, points)
    _caption(session, aim, corner)
    return intents


def _caption(session: Session, aim: Aim, corner: imgui.ImVec2) -> None:
    """What is shown, in the corner."""
    view = session.view
    text = f"{view.mode.capitalize()}   {'Orthographic' if view.camera.orthographic else 'Perspective'}"
    if grid.shown(session):
        text += f"   Grid {aim.step:g}"
    inset = imgui.get_font_size() * 0.6
    for shift, color in ((1.0, (0.0, 0.0, 0.0, 0.6)), (0.0, (1.0, 1.0, 1.0, 0.85))):
        at = corner.x + inset + shift, corner.y + inset + shift
        imgui.get_window_draw_list().add_text(at, imgui.get_color_u32(color), text)
