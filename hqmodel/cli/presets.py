"""hqmodel presets: what is built in."""

from __future__ import annotations

from hqmodel.files import builtin

from .options import Json, Quiet
from .outputs import tell


def presets(as_json: Json = False, quiet: Quiet = False) -> None:
    """List the built-in presets.

    Each can be given by its name wherever a preset is asked for.
    """
    found = builtin()
    width = max((len(preset.name) for preset in found), default=0)
    text = "\n".join(f"{preset.name:{width}}  {preset.title}" for preset in found)
    fields = ("name", "title", "description", "collection")
    listed = [{**{field: getattr(preset, field) for field in fields}, "file": str(preset.path)} for preset in found]
    tell({"presets": listed}, text, as_json, quiet)
