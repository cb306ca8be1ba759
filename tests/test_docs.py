"""The pages under docs/ and the README: every block of Python runs, and nothing is left out of what they list."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from docs.fields import table
from docs.lessons import run
from hqmodel.cli.main import run as run_command
from hqmodel.model import Group, Scene, Shape, Strip, Transform

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
WITH_PYTHON = [page for page in PAGES if "```python\n" in page.read_text(encoding="utf-8")]
LINK = re.compile(r"\]\((?!https?:)([^)#]+)\)")


def shown(link: str, names: dict[str, Any]) -> None:
    """What a picture is made from is there."""
    scenes = names.get("scenes", [names.get("scene")])
    assert scenes
    assert all(isinstance(scene, Scene) for scene in scenes), link


def unseen(link: str, names: dict[str, Any]) -> None:
    """Pictures of other pages are made otherwise."""


@pytest.mark.parametrize("page", WITH_PYTHON, ids=lambda page: page.stem)
def test_every_block_of_python_runs(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    lesson = page.stem in ("tutorial", "model")
    assert run(page, shown if lesson else unseen) == page.read_text(encoding="utf-8").count("```python\n")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_links_and_pictures_lead_somewhere(page: Path) -> None:
    for link in LINK.findall(page.read_text(encoding="utf-8")):
        assert (page.parent / link).is_file(), link


def test_the_readme_leads_to_every_page() -> None:
    assert {ROOT / link for link in LINK.findall(PAGES[0].read_text(encoding="utf-8"))} >= set(PAGES[1:])


def test_pictures_are_small() -> None:
    assert sum(path.stat().st_size for path in (ROOT / "docs/images").glob("*-*.jpg")) < 600_000


def test_the_format_page_has_every_number_and_every_key() -> None:
    text = (ROOT / "docs/format.md").read_text(encoding="utf-8")
    assert table() in text, "run python -m docs.fields"
    for value in (Scene, Shape, Group, Strip, Transform):
        for key in value.model_fields:
            assert re.search(rf"\b{key}\b", text), key


def sections() -> dict[str, str]:
    """The command line's page: what stands below each heading."""
    text = (ROOT / "docs/command-line.md").read_text(encoding="utf-8")
    _, *parts = re.split(r"^## (.+)\n", text, flags=re.MULTILINE)
    return dict(zip(parts[::2], parts[1::2], strict=True))


def options(text: str) -> set[str]:
    return set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", text))


def helped(command: str, capsys: pytest.CaptureFixture[str]) -> str:
    assert run_command([command, "--help"] if command else ["--help"]) == 0
    return capsys.readouterr().out


def test_the_page_of_the_command_line_has_every_command_and_no_other(capsys: pytest.CaptureFixture[str]) -> None:
    listed = re.findall(r"^  ([a-z]+)  ", helped("", capsys).split("Commands:")[1], re.MULTILINE)
    assert len(listed) > 8
    assert set(sections()) - {"Options that mean the same everywhere"} == set(listed)


@pytest.mark.parametrize("command", [name for name in sections() if name.islower()])
def test_the_page_of_the_command_line_has_every_option_and_no_other(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    table = "\n".join(line for line in sections()[command].splitlines() if line.startswith("|"))
    assert options(table) == options(helped(command, capsys).split("Options:")[1])
