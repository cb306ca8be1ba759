"""Controls for a scene's fields, driven by the FIELDS table: label on the left, control on the right, intents out of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from imgui_bundle import imgui

from hqmodel import edit
from hqmodel.model import FIELDS, Number, Scene, pattern, place

from .intents import Animate, Grab, Intent, Location, Put, Reset

# The share of a panel's width that labels take.
LABELS = 0.36
_SLIDER = {False: imgui.SliderFlags_.none, True: imgui.SliderFlags_.logarithmic}


@dataclass
class Memory:
    """What controls remember from one frame to the next while they are held: the slider's range, say."""

    spans: dict[str, tuple[float, float]] = field(default_factory=dict)
    angles: dict[str, tuple[Sequence[float], Sequence[float]]] = field(default_factory=dict)
    turns: dict[str, tuple[Scene, float]] = field(default_factory=dict)


class Form:
    """Draws controls of one scene, in the current window, and collects what they want done in `intents`."""

    def __init__(self, scene: Scene, memory: Memory) -> None:
        self.scene = scene
        self.memory = memory
        self.intents: list[Intent] = []

    def label(self, label: str, help: str = "") -> None:
        """The label, and the cursor where the control begins."""
        imgui.align_text_to_frame_padding()
        imgui.text_unformatted(label)
        _explained(help)
        imgui.same_line(imgui.get_content_region_avail().x * LABELS)

    def number(self, location: Location, label: str = "") -> None:
        """The slider of a number, or of each part of a vector, that has a place in FIELDS."""
        spec = FIELDS.get(pattern(location))
        if spec is None:
            spec = FIELDS[pattern(location) + "[]"]
            self._vector(location, spec, label or spec.label)
            return
        self.label(label or spec.label, _help(spec))
        self.slider(location, spec, label or spec.label)

    def slider(self, location: Location, spec: Number, label: str, prefix: str = "", width: float = -1.0) -> None:
        """The slider alone, its label hidden; typed values may leave its range as far as the format permits."""
        value = float(edit.get(self.scene, location))
        changed, held = self._slid(location, spec, label, value, prefix + _digits(value), width)
        if changed:
            self.intents.append(Put(location, held, label))
        self._resettable(location, spec, label)
        _explained(_help(spec))

    def together(self, name: Location, locations: Sequence[Location], spec: Number) -> None:
        """One slider for the same number of several things; it says so where they differ."""
        values = [float(edit.get(self.scene, location)) for location in locations]
        shown = _digits(values[0]) if min(values) == max(values) else "varied"
        changed, held = self._slid(name, spec, spec.label, values[0], shown, -1.0)
        if changed:
            self.intents += [Put(location, held, spec.label) for location in locations]
        _explained(_help(spec))

    def color(self, location: Location, *others: Location) -> None:
        """A colour's three numbers, with a picker; the others get the same."""
        spec = FIELDS[pattern(location) + "[]"]
        self.label(spec.label, _help(spec))
        imgui.set_next_item_width(-1)
        flags = imgui.ColorEditFlags_.float | imgui.ColorEditFlags_.display_rgb
        changed, value = imgui.color_edit3(f"##{place(location)}", list(edit.get(self.scene, location)), flags)
        self._watched(location, spec.label)
        if changed:
            color = tuple(round(min(1.0, max(0.0, part)), 4) for part in value)
            self.intents += [Put(each, color, spec.label) for each in (location, *others)]

    def rotation(self, location: Location) -> None:
        """A unit quaternion as three angles in degrees, about x, then y, then z."""
        spec = FIELDS[pattern(location) + "[]"]
        name, stored = place(location), edit.get(self.scene, location)
        known, angles = self.memory.angles.get(name, ((), ()))
        angles = list(angles) if known == stored else list(edit.angles(stored))
        self.label(spec.label, f"{spec.help} Shown as angles about x, then y, then z, in degrees.")
        width = _third()
        for axis, letter in enumerate("xyz"):
            imgui.set_next_item_width(width)
            changed, angle = imgui.slider_float(f"##{name}.{letter}", angles[axis], -180.0, 180.0, f"{letter}  %.1f°")
            self._watched(location, spec.label)
            if changed:
                angles[axis] = round(angle, 3)
                turned = edit.quaternion(*angles)
                self.memory.angles[name] = turned, angles
                self.intents.append(Put(location, turned, spec.label))
            self._resettable(location, spec, spec.label)
            if axis < 2:
                imgui.same_line(0, imgui.get_style().item_inner_spacing.x)

    def text(self, location: Location, label: str, lines: int = 1) -> None:
        """A line of text, or several."""
        self.label(label)
        imgui.set_next_item_width(-1)
        before, name = edit.get(self.scene, location), f"##{place(location)}"
        if lines == 1:
            changed, value = imgui.input_text(name, before)
        else:
            size = (-1.0, imgui.get_text_line_height() * lines + 2 * imgui.get_style().frame_padding.y)
            changed, value = imgui.input_text_multiline(name, before, size, imgui.InputTextFlags_.word_wrap)
        self._watched(location, label)
        if changed:
            self.intents.append(Put(location, value, label))

    def toggle(self, location: Location, label: str, help: str = "") -> None:
        """A check box."""
        self.label(label, help)
        changed, value = imgui.checkbox(f"##{place(location)}", edit.get(self.scene, location))
        if changed:
            self.intents.append(Put(location, value, label))

    def choice(self, location: Location, label: str, options: Mapping[str, object], help: str = "") -> None:
        """One of a few values, side by side, by their names."""
        self.label(label, help)
        value = edit.get(self.scene, location)
        left = imgui.get_cursor_pos_x()
        for index, (name, option) in enumerate(options.items()):
            if index:
                imgui.same_line()
                if imgui.get_content_region_avail().x < imgui.calc_text_size(name).x + 2 * imgui.get_frame_height():
                    imgui.new_line()
                    imgui.set_cursor_pos_x(left)
            if imgui.radio_button(f"{name}##{place(location)}", value == option) and value != option:
                self.intents.append(Put(location, option, label))
            _explained(help)

    def _slid(self, location: Location, spec: Number, label: str, value: float, shown: str, width: float) -> tuple[bool, float]:
        """A slider whose range stays as it is while it is held; whether it moved, and where to."""
        name = place(location)
        low, high = self.memory.spans.get(name) or _span(spec, value)
        imgui.set_next_item_width(width)
        changed, held = imgui.slider_float(f"##{name}", value, low, high, shown, _SLIDER[spec.logarithmic])
        if self._watched(location, label):
            self.memory.spans[name] = low, high
        elif not imgui.is_item_active():
            self.memory.spans.pop(name, None)
        return changed, _shortest(held)

    def _vector(self, location: Location, spec: Number, label: str) -> None:
        self.label(label, _help(spec))
        width = _third()
        flat = self.scene.dimension == 2 and location[-1] == "normal"
        for index, part in enumerate(spec.parts[:2] if flat else spec.parts):
            if index:
                imgui.same_line(0, imgui.get_style().item_inner_spacing.x)
            self.slider((*location, index), spec, label, f"{part}  ", width)

    def _watched(self, location: Location, label: str) -> bool:
        """Whether the last item was pressed just now; then what it changes until it is let go is one step."""
        pressed = bool(imgui.is_item_activated())
        if pressed:
            self.intents.append(Grab(location, label))
        return pressed

    def _resettable(self, location: Location, spec: Number, label: str) -> None:
        """Double click resets; so does the context menu."""
        if spec.default is None:
            return
        name = place(location)
        if imgui.is_item_hovered() and imgui.is_mouse_double_clicked(imgui.MouseButton_.left):
            imgui.internal.clear_active_id()
            self.intents.append(Reset(location, label))
        if imgui.begin_popup_context_item(f"reset {name}"):
            if imgui.menu_item_simple("Reset"):
                self.intents.append(Reset(location, label))
            if pattern(location) in FIELDS and imgui.menu_item_simple("Animate..."):
                self.intents.append(Animate(location, label))
            if imgui.menu_item_simple("Copy Path"):
                imgui.set_clipboard_text(name)
            imgui.end_popup()


def _shortest(value: float) -> float:
    """The shortest number that ImGui's single precision cannot tell from this one: 0.1, not 0.10000000149."""
    return float(str(np.float32(value)))


def _third() -> float:
    """The width of one of three controls that share what is left of the row."""
    return (imgui.get_content_region_avail().x - 2 * imgui.get_style().item_inner_spacing.x) / 3


def _span(spec: Number, value: float) -> tuple[float, float]:
    """The slider's range, widened to hold the value with room to either side."""
    low, high = spec.slider
    if value > high:
        high = min(2 * value, spec.high)
    if value < low:
        low = max(value / 2 if spec.logarithmic else 2 * value - high, spec.low)
    return low, high


def _digits(value: float) -> str:
    """Three decimals where they say it all, four digits where they don't."""
    return "%.3f" if 0.01 <= abs(value) < 1e5 or value == 0 else "%.4g"


def _help(spec: Number) -> str:
    bounds = f" {spec.expected().capitalize()}." if spec.expected() != "a finite number" else ""
    return f"{spec.help}{bounds}"


def _explained(help: str) -> None:
    """The tooltip of the last item."""
    if help and imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip) and imgui.begin_tooltip():
        imgui.push_text_wrap_pos(imgui.get_font_size() * 22)
        imgui.text_unformatted(help)
        imgui.pop_text_wrap_pos()
        imgui.end_tooltip()
