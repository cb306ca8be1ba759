"""The context: there is one, and where there is none one sentence says what to install."""

from __future__ import annotations

from typing import Any

import moderngl
import pytest

from hqmodel.gpu import GpuError, offscreen
from hqmodel.gpu.context import REQUIRED, framebuffer_kept
from hqmodel.gpu.screen import is_slow


def test_offscreen_gives_what_the_shaders_ask_for(ctx: moderngl.Context) -> None:
    assert ctx.version_code >= REQUIRED


def test_the_message_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    def none(**_: Any) -> moderngl.Context:
        raise ValueError("no display\nno device")

    monkeypatch.setattr(moderngl, "create_context", none)
    with pytest.raises(GpuError, match="libegl1 and libgl1-mesa-dri") as caught:
        offscreen()
    assert "\n" not in str(caught.value)


def test_the_bound_framebuffer_is_bound_again(ctx: moderngl.Context) -> None:
    mine, other = (ctx.framebuffer([ctx.texture((4, 4), 4)]) for _ in range(2))
    mine.use()
    with framebuffer_kept(ctx):
        other.use()
    assert ctx.detect_framebuffer().glo == mine.glo
    ctx.detect_framebuffer(0).use()
    for framebuffer in (mine, other):
        framebuffer.release()


@pytest.mark.parametrize(("renderer", "slow"), [("llvmpipe (LLVM 15.0.6, 256 bits)", True), ("NVIDIA RTX A4000", False)])
def test_software_renderers_are_known_by_name(renderer: str, slow: bool) -> None:
    class Named:
        def __init__(self) -> None:
            self.info, self.extra = {"GL_RENDERER": renderer}, None

        def query(self, samples: bool) -> None:
            assert samples

    assert is_slow(Named()) == slow  # type: ignore[arg-type]
