"""The status bar: what is there, what was done last, what to know about the body, and an export on its way."""

from __future__ import annotations

from imgui_bundle import imgui

from ..intents import Do, Intent
from ..session import Session

ERROR = (0.95, 0.45, 0.4, 1.0)
NOTICE = (0.95, 0.75, 0.35, 1.0)


def draw(session: Session, point: tuple[float, float, float] | None = None) -> list[Intent]:
    """One line; the last thing said on the left, on the right the counts and the `point` of the surface under the pointer."""
    intents = _export(session)
    if session.failed:
        imgui.text_colored(ERROR, session.message)
    else:
        imgui.text_unformatted(session.message)
    note, counts = notice(session), f"{_pointed(point)}{summary(session)}{_frame_time(session)}"
    imgui.same_line()
    right = imgui.calc_text_size(counts).x + imgui.calc_text_size(note).x + 3 * imgui.get_style().item_spacing.x
    imgui.set_cursor_pos_x(max(imgui.get_cursor_pos_x(), imgui.get_window_width() - right))
    if note:
        imgui.text_colored(NOTICE, note)
        imgui.same_line()
    imgui.text_disabled(counts)
    return intents


def summary(session: Session) -> str:
    scene = session.shown
    shapes, strips = len(scene.shapes), scene.strip_count
    exported = "" if session.exported is None else f"   {session.exported.report['faces']:,} triangles exported"
    return f"{shapes} shape{'s' * (shapes != 1)}   {strips} strip{'s' * (strips != 1)}   t = {scene.slice:.4g}{exported}"


def _pointed(point: tuple[float, float, float] | None) -> str:
    return "" if point is None else "({:.3f}, {:.3f}, {:.3f})   ".format(*point)


def _frame_time(session: Session) -> str:
    """How long a frame takes, averaged over the last ones, when that is asked for."""
    return f"   {1000 / max(imgui.get_io().framerate, 1e-3):.1f} ms a frame" if session.preferences.frame_time else ""


def notice(session: Session) -> str:
    """What is unusual about the body: it is nowhere, or cut by a box; the box is named."""
    box = session.shown_region
    if box.empty:
        return "Nothing to see: the body is empty"
    if not box.cut or session.scene.dimension == 2:
        return ""
    low, high = ("(" + ", ".join(f"{part:.3g}" for part in corner) + ")" for corner in (box.low, box.high))
    return f"{'Cut' if box.bounded else 'Endless, shown cut'} by the box {low} to {high}"


def _export(session: Session) -> list[Intent]:
    """Progress and a way out, while an export is on its way."""
    job = session.job
    if job is None:
        return []
    rest = job.remaining
    left = "" if rest is None else f", {rest:.0f} s left"
    imgui.progress_bar(job.progress, (imgui.get_font_size() * 18, 0), f"{job.stage} {job.progress:.0%}{left}")
    imgui.same_line()
    stopped = imgui.small_button("Stop")
    imgui.same_line()
    return [Do("stop export")] if stopped else []
