"""Preset files: reading with precise errors, atomic writing, what is built in, and the program's settings."""

from .atomic import atomic
from .builtin import Builtin, builtin
from .dump import dumps, save
from .errors import PresetError
from .load import find, load, parse
from .schema import schema, schema_text
from .settings import Settings, settings_folder

__all__ = [
    "Builtin",
    "PresetError",
    "Settings",
    "atomic",
    "builtin",
    "dumps",
    "find",
    "load",
    "parse",
    "save",
    "schema",
    "schema_text",
    "settings_folder",
]
