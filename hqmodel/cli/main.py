"""The program's entry: which command is meant, and the exit status."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from hqmodel import __version__
from hqmodel.files import PresetError, find

from . import animate, check, edit, export, figures, fit, new, presets, raycast, render, sample, section
from .faults import guarded


class Commands(TyperGroup):
    """The commands; where none is named, `edit` is meant, with whatever is given. --version means the same after each."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        if "--version" in args[: args.index("--") if "--" in args else None]:
            args = ["--version"]
        own = {"-h", "--help", "--version"}
        if not args or args[0] not in own | set(self.commands):
            self._refuse_slip(ctx, args[0] if args else "")
            args = ["edit", *args]
        return super().parse_args(ctx, args)

    def _refuse_slip(self, ctx: Any, word: str) -> None:
        """A mistyped command is no preset."""
        close = get_close_matches(word, self.commands, n=1, cutoff=0.7)
        if close and not Path(word).exists():
            try:
                find(word)
            except PresetError:
                ctx.fail(f"expected a command or a preset, got {word!r}: did you mean {close[0]}?")


app = typer.Typer(
    cls=Commands,
    add_completion=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="A desktop modeller that shapes hyperquadrics like clay. Without a command the modeller opens: hqmodel [PRESET].",
)


def _version(wanted: bool) -> None:
    if wanted:
        print(f"hqmodel {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")] = False,
) -> None:
    """See `Commands`."""


for _module in (edit, export, render, animate, section, sample, raycast, fit, new, check, presets, figures):
    app.command()(getattr(_module, _module.__name__.rpartition(".")[2]))


def run(arguments: Sequence[str]) -> int:
    """Carry out a command line, told in full on stdout and stderr; the exit status."""

    def invoke() -> None:
        command = typer.main.get_command(app)
        with command.make_context("hqmodel", list(arguments)) as context:
            command.invoke(context)

    return guarded(invoke)


def open_window(path: Path | None) -> int:
    """Open the modeller with that file, and tell what is wrong with it there; the exit status."""
    return guarded(lambda: edit.window(path))
