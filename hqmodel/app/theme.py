"""How the window looks: two neutral themes, dark and light, with one accent, and room to breathe."""

from __future__ import annotations

from imgui_bundle import hello_imgui, imgui

Color = tuple[float, float, float, float]

ACCENT: Color = (0.86, 0.52, 0.28, 1.0)


def enlarged(percent: int) -> float:
    """How many pixels one of a usual screen is here, with everything in the window so many hundredths of its usual size."""
    return percent / 100 * hello_imgui.dpi_window_size_factor()


def apply(name: str, scale: float, size: float) -> None:
    """Set ImGui's style; lengths are multiplied by the screen's scale, and they and the letters by the size that is wanted."""
    style = imgui.get_style()
    style.font_scale_main, scale = size, scale * size
    imgui.style_colors_light() if name == "light" else imgui.style_colors_dark()
    for field, value in _SPACES.items():
        scaled = (value[0] * scale, value[1] * scale) if isinstance(value, tuple) else value * scale
        setattr(style, field, scaled)
    style.selectable_text_align = imgui.ImVec2(0.0, 0.5)
    for slot, color in _colors(name == "light").items():
        style.set_color_(slot, color)


_SPACES: dict[str, float | tuple[float, float]] = {
    "window_padding": (10.0, 8.0),
    "frame_padding": (8.0, 4.0),
    "item_spacing": (8.0, 6.0),
    "item_inner_spacing": (6.0, 4.0),
    "cell_padding": (4.0, 3.0),
    "indent_spacing": 18.0,
    "scrollbar_size": 12.0,
    "grab_min_size": 8.0,
    "window_rounding": 4.0,
    "child_rounding": 4.0,
    "frame_rounding": 4.0,
    "popup_rounding": 4.0,
    "grab_rounding": 3.0,
    "tab_rounding": 4.0,
    "scrollbar_rounding": 6.0,
    "window_border_size": 1.0,
    "docking_separator_size": 2.0,
}


def _grey(level: float, alpha: float = 1.0) -> Color:
    return level, level, level, alpha


def _tinted(alpha: float) -> Color:
    return (*ACCENT[:3], alpha)


def _colors(light: bool) -> dict[imgui.Col_, Color]:
    """Greys from the back to the front; `level` turns a dark theme's grey into the light one's."""

    def level(dark: float, alpha: float = 1.0) -> Color:
        return _grey(1.0 - 0.75 * dark if light else dark, alpha)

    c = imgui.Col_
    return {
        c.text: _grey(0.1 if light else 0.88),
        c.text_disabled: _grey(0.45 if light else 0.56),
        c.text_link: (0.62, 0.3, 0.08, 1.0) if light else (0.93, 0.66, 0.45, 1.0),
        c.window_bg: level(0.14),
        c.child_bg: _grey(0.0, 0.0),
        c.popup_bg: level(0.11, 0.98),
        c.border: level(0.26),
        c.frame_bg: level(0.22),
        c.frame_bg_hovered: level(0.28),
        c.frame_bg_active: level(0.32),
        c.title_bg: level(0.09),
        c.title_bg_active: level(0.11),
        c.menu_bar_bg: level(0.1),
        c.scrollbar_bg: _grey(0.0, 0.0),
        c.scrollbar_grab: level(0.32),
        c.check_mark: ACCENT,
        c.slider_grab: _tinted(0.5),
        c.slider_grab_active: ACCENT,
        c.button: level(0.24),
        c.button_hovered: level(0.32),
        c.button_active: _tinted(0.6),
        c.header: _tinted(0.28),
        c.header_hovered: level(0.3),
        c.header_active: _tinted(0.5),
        c.separator: level(0.26),
        c.separator_hovered: _tinted(0.6),
        c.separator_active: ACCENT,
        c.resize_grip: level(0.26),
        c.resize_grip_hovered: _tinted(0.6),
        c.resize_grip_active: ACCENT,
        c.tab: level(0.1),
        c.tab_hovered: level(0.26),
        c.tab_selected: level(0.14),
        c.tab_selected_overline: ACCENT,
        c.tab_dimmed: level(0.1),
        c.tab_dimmed_selected: level(0.14),
        c.tab_dimmed_selected_overline: level(0.26),
        c.docking_preview: _tinted(0.5),
        c.docking_empty_bg: level(0.08),
        c.plot_histogram: _tinted(0.55),
        c.table_header_bg: level(0.18),
        c.table_border_light: level(0.2),
        c.table_border_strong: level(0.26),
        c.text_selected_bg: _tinted(0.4),
        c.drag_drop_target: ACCENT,
        c.nav_cursor: ACCENT,
        c.modal_window_dim_bg: _grey(0.0, 0.5),
    }
