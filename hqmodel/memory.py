"""How much memory is to be had, asked before work that may want more of it than there is."""

from __future__ import annotations

import ctypes
import os
import re
import sys
from math import inf
from pathlib import Path

_PROC, _GROUPS = Path("/proc"), Path("/sys/fs/cgroup")


def available() -> float:
    """Bytes that this process may still take, as far as the system tells: of the machine's, its group's and its own; else inf."""
    return max(0.0, min(_machine(), _group(), _own()))


def told(size: float) -> str:
    """A number of bytes as people write it: 1.2 GB."""
    for unit, word in ((1e9, "GB"), (1e6, "MB")):
        if size >= unit:
            return f"{size / unit:.2g} {word}" if size < 100 * unit else f"{size / unit:.0f} {word}"
    return f"{size / 1e3:.0f} kB"


if sys.platform == "win32":

    class _Status(ctypes.Structure):
        """MEMORYSTATUSEX."""

        _fields_ = (
            ("length", ctypes.c_ulong),
            ("load", ctypes.c_ulong),
            ("total", ctypes.c_ulonglong),
            ("free", ctypes.c_ulonglong),
            ("rest", ctypes.c_ulonglong * 5),
        )

    def _machine() -> float:
        """What can be had without swapping."""
        status = _Status(length=ctypes.sizeof(_Status))
        known = ctypes.windll.kernel32.GlobalMemoryStatusEx(ctypes.byref(status))
        return float(status.free) if known else inf

    def _own() -> float:
        """Windows has no limit on addresses."""
        return inf

else:
    import resource

    def _machine() -> float:
        """What can be had without swapping; where only all of it is known, that."""
        found = re.search(r"^MemAvailable: *(\d+) kB$", _read(_PROC / "meminfo"), re.MULTILINE)
        return 1024.0 * int(found[1]) if found else float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))

    def _own() -> float:
        """What the shell's limit on addresses (ulimit -v) leaves."""
        limit, _ = resource.getrlimit(resource.RLIMIT_AS)
        if limit == resource.RLIM_INFINITY:
            return inf
        pages = _read(_PROC / "self/statm").split()
        return float(limit) - (int(pages[0]) * os.sysconf("SC_PAGE_SIZE") if pages else 0)


def _group() -> float:
    """What the control group that a container or a service runs in leaves, and each that this one is part of."""
    found = re.search(r"^0::/(.*)$", _read(_PROC / "self/cgroup"), re.MULTILINE)
    left = inf
    folder = _GROUPS / found[1] if found else _GROUPS
    for group in (folder, *folder.parents):
        if not group.is_relative_to(_GROUPS):
            break
        limit, used = _read(group / "memory.max").strip(), _read(group / "memory.current").strip()
        cached = re.search(r"^inactive_file (\d+)$", _read(group / "memory.stat"), re.MULTILINE)
        if limit.isdecimal() and used.isdecimal():
            left = min(left, float(int(limit) - int(used) + int(cached[1] if cached else 0)))
    return left


def _read(path: Path) -> str:
    """A file of the system's; nothing where there is none."""
    try:
        return path.read_text()
    except OSError:
        return ""
