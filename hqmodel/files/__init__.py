"""Preset files: reading with precise errors, atomic writing, copies for safety, what is built in, and the program's settings."""

from .atomic import atomic
from .autosave import Lost, Origin, Ring, lost
from .backups import back_up, backup_folder, fingerprint
from .builtin import Builtin, builtin
from .dump import dumps, save
from .errors import PresetError
from .folders import filling
from .load import find, load, parse
from .pictures import Pictures
from .schema import schema, schema_text
from .settings import Settings, settings_folder, state_folder

__all__ = [
    "Builtin",
    "Lost",
    "Origin",
    "Pictures",
    "PresetError",
    "Ring",
    "Settings",
    "atomic",
    "back_up",
    "backup_folder",
    "builtin",
    "dumps",
    "filling",
    "find",
    "fingerprint",
    "load",
    "lost",
    "parse",
    "save",
    "schema",
    "schema_text",
    "settings_folder",
    "state_folder",
]
