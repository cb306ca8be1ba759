"""The window: hello_imgui's docked panels around one session, and what it owes the system."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from pathlib import Path

import moderngl
from imgui_bundle import hello_imgui, imgui

from hqmodel.gpu import Legend, Seen

from . import display, filing, layout, native, theme
from .asks import ChooseFile, Quit
from .canvas import Canvas
from .dialogs import front
from .form import Memory
from .guard import Guard
from .hands.hand import Hand
from .intents import Intent, Release
from .panels import landscape, menus, outliner, presets, properties, scene, slice_bar, status, timeline, viewport
from .session import Session
from .shelf import stocked
from .thumbnails import Thumbnails

# Idle, the window draws one frame in so many seconds; whatever happens wakes it at once.
IDLE_SECONDS = 10.0
# It goes on drawing for so long after the last event, for tooltips to appear.
AWAKE_SECONDS = 0.7
# The preview is refined when the hand has been still for so long; how long, and what it may then take of each frame.
CALM = ((0.15, 0.03), (1.5, 0.12))
SIZE = 1280, 800
# The height of the bar along the bottom, in heights of the font.
SLICE_BAR = 2.6


class Window:
    """Draws a session until it is finished. `params` is what hello_imgui runs; `scale` the screen's, where that won't find it."""

    def __init__(self, session: Session, native_dialogs: bool = True, scale: float = 1.0) -> None:
        self.session = session
        session.wake = hello_imgui.request_refresh
        self.guard = Guard(session)
        self._memory = Memory()
        self._tree = outliner.Tree()
        self._slider = slice_bar.Slider()
        self._reel = timeline.Reel()
        self.ground = landscape.Ground()
        self._shelf = stocked()
        self.hand = Hand()
        self.chooser = native.NativeChooser() if native_dialogs and native.available() else None
        self._shown = layout.Shown()
        self._dropped: list[Path] = []
        self._title = ""
        self._stirred = 0.0
        self._themed: tuple[tuple[str, float, float], bool] | None = None
        self.panels = self._panels()
        self.params = self._parameters()
        if scale != 1.0:
            self.params.dpi_aware_params.dpi_window_size_factor = scale

    def run(self) -> None:
        """Until it is closed. Should drawing itself fail, what is not saved is kept before that goes on.

        Raises NoDisplay where the driver loses the window's OpenGL.
        """
        recovery = self.session.recovery
        display.ask_to_be_told()
        try:
            hello_imgui.run(self.params)
        except BaseException:
            kept = recovery.keep(self.session) if self.session.history.dirty else None
            if kept is not None:
                print(f"hqmodel: what was not saved is in {kept}", file=sys.stderr)
            recovery.close(keep=True)
            raise
        recovery.close()

    # What hello_imgui is told

    def _parameters(self) -> hello_imgui.RunnerParams:
        params = hello_imgui.RunnerParams()
        params.app_window_params.window_title = "hqmodel"
        params.app_window_params.window_geometry.size = SIZE
        params.app_window_params.restore_previous_geometry = True
        params.ini_folder_type = hello_imgui.IniFolderType.absolute_path
        params.ini_filename_use_app_window_title = False
        ini = layout.kept_in()
        params.ini_filename, params.ini_disable = str(ini or ""), ini is None
        params.fps_idling.fps_idle = 1 / IDLE_SECONDS
        params.fps_idling.time_active_after_last_event = AWAKE_SECONDS
        # ImGui smooths its own edges, and the preview its own: multisampling would only make every frame slow.
        params.renderer_backend_options.open_gl_options.anti_aliasing_samples = 0
        inner = params.imgui_window_params
        inner.default_imgui_window_type = hello_imgui.DefaultImGuiWindowType.provide_full_screen_dock_space
        inner.show_menu_bar, inner.show_menu_app, inner.show_menu_view = True, False, False
        inner.show_status_bar, inner.show_status_fps, inner.remember_theme = True, False, False
        self._callbacks(params.callbacks)
        draws = {name: self._guarded(name, partial(self._draw, name)) for name in self.panels}
        bar = hello_imgui.EdgeToolbarOptions(size_em=SLICE_BAR, window_padding_em=(0.7, 0.4))
        params.callbacks.add_edge_toolbar(hello_imgui.EdgeToolbarType.bottom, draws.pop("Slice"), bar)
        params.docking_params = layout.docking(draws)
        return params

    def _callbacks(self, callbacks: hello_imgui.RunnerCallbacks) -> None:
        callbacks.default_icon_font = hello_imgui.DefaultIconFont.font_awesome6
        callbacks.post_init = self._begin
        callbacks.pre_new_frame = self._before
        callbacks.show_menus = self._guarded("Menu", lambda: menus.draw(self.session))
        callbacks.show_status = self._guarded("Status", lambda: status.draw(self.session, self.hand.point))
        callbacks.show_gui = self._guarded("Shortcuts", self._keys)
        callbacks.post_render_dockable_windows = self._after
        callbacks.confirm_exit = self._may_exit

    def _panels(self) -> dict[str, Callable[[], Iterable[Intent]]]:
        session, memory = self.session, self._memory
        return {
            "Outliner": lambda: outliner.draw(session, self._tree),
            "Presets": lambda: presets.draw(session, self._shelf, self.thumbnails.texture),
            "Viewport": lambda: viewport.draw(session, self.hand, self),
            "Properties": lambda: properties.draw(session, memory),
            "Scene": lambda: scene.draw(session, memory),
            "Timeline": lambda: timeline.draw(session, self._reel),
            "Landscape": lambda: landscape.draw(session, memory, self.ground),
            "Slice": lambda: slice_bar.draw(session, memory, self._slider),
        }

    def _draw(self, name: str) -> Iterable[Intent]:
        return self.panels[name]()

    def _guarded(self, name: str, draw: Callable[[], Iterable[Intent]]) -> Callable[[], None]:
        return partial(self.guard.run, name, draw)

    # What happens in a frame

    def _begin(self) -> None:
        """Once, when there is a window with OpenGL."""
        import glfw
        from imgui_bundle.glfw_utils import glfw_window_hello_imgui

        ctx = moderngl.create_context()
        self.canvas = Canvas(ctx)
        self.thumbnails = Thumbnails(ctx)
        self.window = glfw_window_hello_imgui()
        self._is_lost = display.loss_of(self.window)
        glfw.set_drop_callback(self.window, self.dropped)  # type: ignore[arg-type]  # its stub has the C signature

    def dropped(self, _: object, paths: Sequence[str]) -> None:
        """Files were dropped on the window; glfw calls this. The first of them opens, in the next frame."""
        self._dropped = [Path(path) for path in paths]
        hello_imgui.request_refresh()

    def _before(self) -> None:
        """Ahead of each frame: what came from outside, the theme, the title, the panels shown, and whether to close."""
        if self._is_lost():
            raise display.NoDisplay(display.LOST)
        session = self.session
        session.poll()
        dropped, self._dropped = self._dropped, []
        if dropped:
            filing.take(session, dropped[0])
        self._restyle()
        self._retitle()
        self._shown.sync(self.params, session)
        if session.finished:
            self.params.app_shall_exit = True

    def _keys(self) -> list[Intent]:
        return menus.shortcuts(self.session)

    def _after(self) -> None:
        """Behind all panels: dialogs, the end of drags, and whether another frame is needed."""
        self.guard.run("Dialog", self._dialog)
        busy = imgui.is_any_item_active() or self.session.held is not None or self.hand.gizmo.before is not None
        if self.session.history.dragging and not busy:
            self.session.apply([Release()])
        better = self.canvas.unfinished and self.session.preferences.refining
        if self.thumbnails.waiting and not better and self.spare():
            self.guard.run("Thumbnails", self._thumbnail)
        # ImGui spreads keys pressed in quick succession over several frames, which a window at rest would not draw
        pressed = len(imgui.get_current_context().input_events_queue) > 0
        under_way = self.session.job or self.session.player.running or self._choosing
        if better or pressed or under_way or self.thumbnails.waiting:
            hello_imgui.request_refresh()

    def _dialog(self) -> Iterable[Intent]:
        if self._choosing and self.chooser is not None:
            asked = self.session.dialogs[-1]
            assert isinstance(asked, ChooseFile)
            return self.chooser.poll(asked)
        return front.draw(self.session)

    @property
    def _choosing(self) -> bool:
        """Whether one of the system's own dialogs is open."""
        dialogs = self.session.dialogs
        return self.chooser is not None and bool(dialogs) and isinstance(dialogs[-1], ChooseFile)

    def spare(self) -> float:
        """The seconds that finer things than a draft may take of this frame: none while somebody is at work."""
        io = imgui.get_io()
        moved = io.mouse_delta.x, io.mouse_delta.y, io.mouse_wheel, io.mouse_wheel_h
        if any(moved) or any(io.mouse_down) or imgui.is_any_item_active():
            self._stirred = imgui.get_time()
        return max((seconds for still, seconds in CALM if imgui.get_time() - self._stirred > still), default=0.0)

    # What the viewport shows: `viewport.Picture`

    def draw(self, size: tuple[int, int]) -> int:
        session = self.session
        spare = self.spare() if session.preferences.refining else 0.0
        texture = self.canvas.draw(session.shown, session.shown_view, size, spare, self.hand.lit)
        session.located(session.shown, self.canvas.region)
        return texture

    def seen(self, size: tuple[int, int], pixel: tuple[int, int]) -> Seen | None:
        return self.canvas.pick(self.session.view, size, pixel)

    @property
    def legend(self) -> Legend:
        return self.canvas.legend

    def _thumbnail(self) -> Iterable[Intent]:
        self.thumbnails.work()
        return ()

    def _may_exit(self) -> bool:
        """The close button was pressed: ask if need be, and close then."""
        if not self.session.finished:
            self.session.apply([Quit()])
            hello_imgui.request_refresh()
        return self.session.finished

    def _restyle(self) -> None:
        wanted = self.session.preferences.theme, hello_imgui.dpi_window_size_factor(), self.session.preferences.percent / 100
        started = imgui.get_frame_count() > 0  # in its first frame hello_imgui scales the style once more
        if (wanted, started) != self._themed:
            theme.apply(*wanted)
            self._themed = wanted, started

    def _retitle(self) -> None:
        import glfw

        title = self.session.document.title
        if title != self._title:
            glfw.set_window_title(self.window, title)
            self._title = title
