"""How the body shall be exported, and what came of it."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np
from imgui_bundle import imgui

from ..asks import ChooseFile, Dialog, ExportAs, Exported, ExportSettings, Method, Unit, Up
from ..intents import Adjust, Answer, Ask, Intent
from ..panels.status import ERROR
from .buttons import buttons
from .fields import combo, file, label

_UNITS: dict[Unit | Literal[""], str] = {
    "": "None: numbers stay as they are",
    "mm": "Millimetres",
    "cm": "Centimetres",
    "m": "Metres",
    "in": "Inches",
}
_METHODS: dict[Method, str] = {
    "cubes": "Marching cubes: any body",
    "radial": "Radial grid: star-shaped, quads with UVs",
}
# What most people want for a purpose: ending, unit, longest side, triangles at most.
_PURPOSES: dict[str, tuple[str, Unit | None, float | None, int | None]] = {
    "Blender": (".glb", None, None, None),
    "3D printing": (".3mf", "mm", 80.0, None),
    "Games": (".glb", "m", 1.0, 20_000),
}
_UPS: dict[Up | None, str] = {"z": "z up", "y": "y up"}
_RESOLUTIONS = 16, 1024
_FACES, _USUAL_FACES = (100, 1_000_000), 20_000
# The usual distance from the true surface, as a share of the longest side.
_USUAL_SHARE = 1e-3


def draw(dialog: Dialog) -> list[Intent]:
    """Format and file, how fine, how large, and what goes along."""
    from hqmodel.mesh import FORMATS, UP_AXIS

    assert isinstance(dialog, ExportAs)
    settings = dialog.settings
    settings = _purpose(settings)
    suffix = settings.path.suffix.lower()
    chosen = combo("Format", suffix, FORMATS)
    if chosen != suffix:
        settings = replace(settings, path=settings.path.with_suffix(chosen))
    path, browsing = file(settings.path)
    settings = replace(settings, path=path)
    settings = replace(settings, method=combo("Made by", settings.method, _METHODS))
    adaptive = settings.method == "cubes" and settings.tolerance is not None
    imgui.begin_disabled(adaptive)
    settings = _resolution(settings)
    imgui.end_disabled()
    imgui.begin_disabled(settings.method == "radial")
    settings = _tolerance(_reduction(settings))
    imgui.end_disabled()
    settings = _size(settings)
    usual = f"As usual for the format: {UP_AXIS.get(chosen, 'z')} up"
    settings = replace(settings, up=combo("Up", settings.up, {None: usual, **_UPS}))
    settings = _extras(settings)
    problem = _problem(settings, list(FORMATS))
    if problem:
        imgui.text_colored(ERROR, problem)
    else:
        imgui.text_disabled((dialog.told(settings) if settings.method == "cubes" else "") or " ")
    pressed = buttons(["Export", "Cancel"], enabled=not problem)
    changed: list[Intent] = [] if settings == dialog.settings else [Adjust(replace(dialog, settings=settings))]
    if browsing:
        return [*changed, Ask(ChooseFile("export", settings.path.parent, settings.path.name, (chosen,)))]
    if pressed == "Cancel":
        return [Answer()]
    return [*changed, Answer(settings)] if pressed else changed


def draw_report(dialog: Dialog) -> list[Intent]:
    """The figures of the mesh that was written."""
    assert isinstance(dialog, Exported)
    imgui.text_unformatted(dialog.path.name)
    imgui.text_disabled(str(dialog.path.parent))
    imgui.spacing()
    if imgui.begin_table("report", 2, imgui.TableFlags_.sizing_fixed_fit):
        for name, value in [*dialog.report.items(), ("seconds", dialog.seconds)]:
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.text_disabled(name.replace("_", " ").capitalize())
            imgui.table_next_column()
            imgui.text_unformatted(_figure(value))
        imgui.end_table()
    return [Answer()] if buttons(["OK"]) else []


def _figure(value: object) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return f"{value:,}"
    if isinstance(value, float):
        return f"{value:.5g}"
    parts = np.asarray(value)
    if parts.ndim == 2:
        return " to ".join(_figure(list(row)) for row in parts)
    return "(" + ", ".join(f"{float(part):.4g}" for part in parts) + ")" if parts.ndim == 1 else str(value)


def _purpose(settings: ExportSettings) -> ExportSettings:
    """Buttons that set everything as a purpose has it."""
    label("For")
    for name, (suffix, unit, size, faces) in _PURPOSES.items():
        if imgui.button(name):
            path = settings.path.with_suffix(suffix)
            settings = ExportSettings(path, settings.resolution, unit=unit, size=size, target_faces=faces)
        imgui.same_line()
    imgui.new_line()
    return settings


def _resolution(settings: ExportSettings) -> ExportSettings:
    label("Resolution")
    flags = imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp
    _, cells = imgui.slider_int("##resolution", settings.resolution, *_RESOLUTIONS, "%d cells along the longest side", flags)
    return replace(settings, resolution=cells)


def _reduction(settings: ExportSettings) -> ExportSettings:
    """To how many triangles the mesh shall be reduced."""
    label("Reduce to")
    wanted, faces = settings.target_faces is not None, settings.target_faces or _USUAL_FACES
    _, wanted = imgui.checkbox("##reduced", wanted)
    imgui.same_line()
    imgui.begin_disabled(not wanted)
    imgui.set_next_item_width(-1)
    flags = imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp
    _, faces = imgui.slider_int("##target faces", faces, *_FACES, "%d triangles", flags)
    imgui.end_disabled()
    return replace(settings, target_faces=faces if wanted else None)


def _tolerance(settings: ExportSettings) -> ExportSettings:
    """How far from the true surface the mesh may be, instead of how fine and of how many triangles it is."""
    label("Within")
    unit = f" {settings.unit}" if settings.unit else ""
    before, length = settings.tolerance is not None, settings.tolerance or _USUAL_SHARE * (settings.size or 1.0)
    _, wanted = imgui.checkbox("##within", before)
    imgui.same_line()
    imgui.begin_disabled(not wanted)
    imgui.set_next_item_width(-1)
    _, length = imgui.input_double("##tolerance", length, 0.0, 0.0, f"%.6g{unit} of the true surface")
    imgui.end_disabled()
    fewer = None if wanted and not before else settings.target_faces
    return replace(settings, tolerance=length if wanted and fewer is None else None, target_faces=fewer)


def _size(settings: ExportSettings) -> ExportSettings:
    """The unit, and how long the longest side shall be in it."""
    unit = combo("Unit", settings.unit or "", _UNITS)
    label("Longest side")
    wanted, size = settings.size is not None, settings.size or 100.0
    _, wanted = imgui.checkbox("##sized", wanted)
    imgui.same_line()
    imgui.begin_disabled(not wanted)
    imgui.set_next_item_width(-1)
    _, size = imgui.input_double("##size", size, 0.0, 0.0, f"%.6g {unit}")
    imgui.end_disabled()
    return replace(settings, unit=unit or None, size=size if wanted else None)


def _extras(settings: ExportSettings) -> ExportSettings:
    label("With")
    _, colors = imgui.checkbox("Colours", settings.colors)
    imgui.same_line()
    _, normals = imgui.checkbox("Normals", settings.normals)
    return replace(settings, colors=colors, normals=normals)


def _problem(settings: ExportSettings, endings: list[str]) -> str:
    if settings.path.suffix.lower() not in endings:
        return f"The file's ending must be one of {', '.join(endings)}"
    if not settings.path.parent.is_dir():
        return f"There is no folder {settings.path.parent}"
    if settings.tolerance is not None and not settings.tolerance > 0:
        return "The distance from the true surface must be above 0"
    if settings.size is not None and not settings.size > 0:
        return "The longest side must be above 0"
    return ""
