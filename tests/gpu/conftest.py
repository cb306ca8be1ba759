"""One off-screen context for all tests here. Without a renderer they fail, and say what to install."""

from __future__ import annotations

from collections.abc import Iterator

import moderngl
import pytest

from hqmodel.gpu import Preview, offscreen


@pytest.fixture(scope="session")
def _context() -> Iterator[moderngl.Context]:
    made = offscreen()
    yield made
    made.release()


@pytest.fixture
def ctx(_context: moderngl.Context) -> Iterator[moderngl.Context]:
    """The context, free of errors before and after each test."""
    with _context:  # other tests may have left another context current
        assert _context.error == "GL_NO_ERROR"
        yield _context
        assert _context.error == "GL_NO_ERROR"


@pytest.fixture
def preview(ctx: moderngl.Context) -> Iterator[Preview]:
    made = Preview(ctx)
    yield made
    made.release()
