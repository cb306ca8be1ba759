"""The outliner: shapes and their strips as a tree, to select, show and hide, name, and put in order."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from hqmodel import edit
from hqmodel.model import Shape

from ..actions import ACTIONS
from ..intents import Do, Edit, Intent, Put, Select
from ..session import Session
from .naming import shape_name, strip_name

_DRAGGED = "hqmodel shape"


@dataclass
class Tree:
    """What the outliner remembers: the shapes whose strips are shown, and the name being typed."""

    open: set[int] = field(default_factory=set)
    renaming: int | None = None
    text: str = ""
    fresh: bool = False


def draw(session: Session, tree: Tree) -> list[Intent]:
    """The tool bar and the tree."""
    intents = _tools(session)
    if not imgui.begin_child("tree"):
        imgui.end_child()
        return intents
    if not session.scene.shapes:
        imgui.text_wrapped("Nothing here yet. Add a shape with the + above.")
    rows = _rows(session, tree)
    clipper = imgui.ListClipper()
    clipper.begin(len(rows), imgui.get_frame_height_with_spacing())
    while clipper.step():
        for shape, strip in rows[clipper.display_start : clipper.display_end]:
            intents += _shape(session, tree, shape) if strip is None else _strip(session, shape, strip)
    if imgui.is_window_hovered() and not imgui.is_any_item_hovered() and imgui.is_mouse_clicked(imgui.MouseButton_.left):
        intents.append(Select(None))
    imgui.end_child()
    return intents


def _rows(session: Session, tree: Tree) -> list[tuple[int, int | None]]:
    """Every row there is to show, (shape, strip), strip None for the shape's own."""
    rows: list[tuple[int, int | None]] = []
    for index, shape in enumerate(session.scene.shapes):
        rows.append((index, None))
        if _opened(session, tree, index):
            rows += [(index, strip) for strip in range(len(shape.strips))]
    return rows


def _opened(session: Session, tree: Tree, index: int) -> bool:
    """Whether a shape's strips are shown: because it was opened, or one of them is selected."""
    return index in tree.open or (session.selection.strip is not None and index == session.selection.active)


def _tools(session: Session) -> list[Intent]:
    intents: list[Intent] = []
    if imgui.button(icons.ICON_FA_PLUS + "###add"):
        imgui.open_popup("add shape")
    imgui.set_item_tooltip("Add a shape or a strip")
    if imgui.begin_popup("add shape"):
        intents += [Do(f"add {kind}") for kind in edit.PRIMITIVES if imgui.menu_item_simple(kind.capitalize())]
        imgui.separator()
        if imgui.menu_item_simple("Strip", enabled=session.selection.active is not None):
            intents.append(Do("add strip"))
        imgui.end_popup()
    chosen = session.selection.active is not None
    for icon, action, tip in (
        (icons.ICON_FA_COPY, "duplicate", "Duplicate (Ctrl+D)"),
        (icons.ICON_FA_TRASH_CAN, "delete", "Delete (Del)"),
        (icons.ICON_FA_ARROW_UP, "move up", "Move up (Ctrl+Up)"),
        (icons.ICON_FA_ARROW_DOWN, "move down", "Move down (Ctrl+Down)"),
    ):
        _beside(icon)
        imgui.begin_disabled(not chosen)
        if imgui.button(f"{icon}##{action}"):
            intents.append(Do(action))
        imgui.set_item_tooltip(tip)
        imgui.end_disabled()
    return intents


def _beside(icon: str) -> None:
    """The next button stands beside the last one where there is room, else below."""
    style = imgui.get_style()
    needed = style.item_spacing.x + imgui.calc_text_size(icon).x + 2 * style.frame_padding.x
    right = imgui.get_cursor_screen_pos().x + imgui.get_content_region_avail().x
    if imgui.get_item_rect_max().x + needed <= right:
        imgui.same_line()


def _shape(session: Session, tree: Tree, index: int) -> list[Intent]:
    """One shape's row: arrow, colour, name and eye."""
    shape = session.scene.shapes[index]
    imgui.push_id(f"shape {index}")
    if imgui.arrow_button("open", imgui.Dir.down if _opened(session, tree, index) else imgui.Dir.right):
        tree.open ^= {index}
    imgui.same_line()
    imgui.color_button("color", (*shape.color, 1.0), imgui.ColorEditFlags_.no_tooltip | imgui.ColorEditFlags_.no_drag_drop)
    imgui.same_line()
    intents = _renamed(session, tree, index) if tree.renaming == index else _name(session, tree, index, shape)
    intents += _eye(index, shape)
    imgui.pop_id()
    return intents


def _name(session: Session, tree: Tree, index: int, shape: Shape) -> list[Intent]:
    intents: list[Intent] = []
    width = imgui.get_content_region_avail().x - _eye_width()
    if not shape.visible:
        imgui.push_style_color(imgui.Col_.text, imgui.get_style_color_vec4(imgui.Col_.text_disabled))
    selected = index in session.selection.shapes and (index != session.selection.active or session.selection.strip is None)
    sign = "  - carves" if shape.coefficient < 0 else ""
    imgui.internal.get_current_window().dc.curr_line_text_base_offset = 0.0  # it is as high as a frame, and no text within one
    flags = imgui.SelectableFlags_.allow_double_click
    clicked, _ = imgui.selectable(f"{shape_name(shape, index)}{sign}###name", selected, flags, (width, imgui.get_frame_height()))
    if not shape.visible:
        imgui.pop_style_color()
    if clicked:
        intents.append(Select(index, add=imgui.get_io().key_ctrl))
        if imgui.is_mouse_double_clicked(imgui.MouseButton_.left):
            _rename(tree, index, shape)
    intents += _dragged(index, shape)
    if imgui.begin_popup_context_item("menu"):
        intents += _menu(session, tree, index, shape)
        imgui.end_popup()
    return intents


def _menu(session: Session, tree: Tree, index: int, shape: Shape) -> list[Intent]:
    pick = [] if index in session.selection.shapes else [Select(index)]
    if imgui.menu_item_simple("Rename"):
        _rename(tree, index, shape)
    for label, action in (("Add Strip", "add strip"), ("Duplicate", "duplicate"), ("Delete", "delete")):
        if imgui.menu_item_simple(label):
            return [*pick, Do(action)]
    if imgui.menu_item_simple("Frame"):
        return [Select(index), Do("frame selected")]
    return []


def _rename(tree: Tree, index: int, shape: Shape) -> None:
    tree.renaming, tree.text, tree.fresh = index, shape.name, True


def _renamed(session: Session, tree: Tree, index: int) -> list[Intent]:
    """The name being typed, for all shapes if several are selected: Enter or a click elsewhere takes it, Esc does not."""
    if tree.fresh:
        imgui.set_keyboard_focus_here()
        tree.fresh = False
    imgui.set_next_item_width(-_eye_width())
    flags = imgui.InputTextFlags_.auto_select_all | imgui.InputTextFlags_.enter_returns_true
    entered, tree.text = imgui.input_text("##rename", tree.text, flags)
    if not (entered or imgui.is_item_deactivated()):
        return []
    tree.renaming = None
    if imgui.is_key_pressed(imgui.Key.escape) or tree.text == session.scene.shapes[index].name:
        return []
    chosen = session.selection.shapes if index in session.selection.shapes else (index,)
    return [Edit("Rename", partial(edit.rename_shapes, indices=chosen, name=tree.text))]


def _dragged(index: int, shape: Shape) -> list[Intent]:
    """Dragging one shape's row onto another's puts it there."""
    if imgui.begin_drag_drop_source():
        imgui.set_drag_drop_payload_py_id(_DRAGGED, index)
        imgui.text_unformatted(shape_name(shape, index))
        imgui.end_drag_drop_source()
    if not imgui.begin_drag_drop_target():
        return []
    dropped = imgui.accept_drag_drop_payload_py_id(_DRAGGED)
    imgui.end_drag_drop_target()
    if dropped is None or dropped.data_id == index:
        return []
    return [Edit("Reorder", partial(edit.move_shape, index=dropped.data_id, to=index)), Select(index)]


def _eye_width() -> float:
    """With the space before it."""
    return 1.2 * imgui.get_frame_height() + imgui.get_style().item_spacing.x


def _eye(index: int, shape: Shape) -> list[Intent]:
    imgui.same_line()
    imgui.push_style_color(imgui.Col_.button, (0, 0, 0, 0))
    icon = icons.ICON_FA_EYE if shape.visible else icons.ICON_FA_EYE_SLASH
    clicked = imgui.button(f"{icon}###eye", (1.2 * imgui.get_frame_height(), 0))
    imgui.pop_style_color()
    imgui.set_item_tooltip("Hide" if shape.visible else "Show")
    return [Put(("shapes", index, "visible"), not shape.visible, "Hide" if shape.visible else "Show")] if clicked else []


def _strip(session: Session, shape: int, index: int) -> list[Intent]:
    strip = session.scene.shapes[shape].strips[index]
    imgui.push_id(f"strip {shape} {index}")
    imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + 2 * imgui.get_frame_height())
    selected = session.selection.active == shape and session.selection.strip == index
    group = f"   {strip.group}" if strip.group else ""
    clicked, _ = imgui.selectable(f"{strip_name(strip, index)}{group}###name", selected, size=(0, imgui.get_frame_height()))
    intents: list[Intent] = [Select(shape, index)] if clicked else []
    if imgui.begin_popup_context_item("menu"):
        for action in ("duplicate", "delete", "move up", "move down"):
            if imgui.menu_item_simple(ACTIONS[action].label):
                intents += [Select(shape, index), Do(action)]
        imgui.end_popup()
    imgui.pop_id()
    return intents
