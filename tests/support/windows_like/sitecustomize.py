"""A Python that lacks what Windows lacks, and writes text as Windows does: put this folder on PYTHONPATH.

Gone are `fcntl` and its like, `fork` and the pools made by it, POSIX-only calls, flags and signals.
Files that are opened as text without an encoding are taken as cp1252, and lines end with CRLF. Python's
own machinery, which starts and ends processes, keeps what it has taken before.
"""

from __future__ import annotations

import builtins
import contextlib
import io
import multiprocessing
import os
import shutil
import signal
import subprocess  # noqa: F401  # takes what it needs of this system before it is gone
import sys
import tempfile  # noqa: F401  # likewise
import types
from multiprocessing import context, popen_spawn_posix, resource_tracker  # noqa: F401  # likewise
from typing import IO, Any

MODULES = ("fcntl", "resource", "pwd", "grp", "termios", "tty", "pty")
CALLS = (
    "fork", "forkpty", "getuid", "geteuid", "getgid", "getegid", "killpg", "setsid", "mkfifo", "chown",
    "sched_getaffinity", "nice", "statvfs", "register_at_fork",
)  # fmt: skip
FLAGS = ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_DIRECTORY", "O_SYNC")
SIGNALS = ("SIGHUP", "SIGALRM", "SIGUSR1", "SIGUSR2", "SIGCHLD", "SIGPIPE", "SIGQUIT")

with contextlib.suppress(ImportError):
    import filelock  # noqa: F401  # with this system's locks in the place of Windows' own
    import platformdirs.unix  # noqa: F401  # chosen by `sys.platform`, which stays as it is

_whole_os = types.ModuleType("os")
_whole_os.__dict__.update(os.__dict__)
for _name, _part in list(sys.modules.items()):
    if _name.startswith("filelock.") and hasattr(_part, "os"):
        _part.os = _whole_os  # its locks stay whole

_open = io.open


def _windows_open(
    file: Any,  # noqa: ANN401  # as the built-in
    mode: str = "r",
    buffering: int = -1,
    encoding: str | None = None,
    errors: str | None = None,
    newline: str | None = None,
    **more: Any,  # noqa: ANN401  # likewise
) -> IO[Any]:
    """Open a file with the defaults of a Western European Windows."""
    if "b" not in mode:
        encoding = "cp1252" if encoding in {None, "locale"} else encoding
        if newline is None and set(mode) & set("wax+"):
            newline = "\r\n"
    return _open(file, mode, buffering, encoding, errors, newline, **more)


for _module in MODULES:
    sys.modules[_module] = None  # so that its import fails
for _call in (*CALLS, *FLAGS):
    with contextlib.suppress(AttributeError):
        delattr(os, _call)
shutil._use_fd_functions = False  # as it finds for itself where folders cannot be opened
for _signal in SIGNALS:
    with contextlib.suppress(AttributeError):
        delattr(signal, _signal)
for _method in ("fork", "forkserver"):
    context._concrete_contexts.pop(_method, None)  # nothing else says what there is
multiprocessing.get_all_start_methods = lambda: ["spawn"]
multiprocessing.set_start_method("spawn")
io.open = builtins.open = _windows_open  # it takes the same arguments
for _stream in (sys.stdout, sys.stderr):
    if isinstance(_stream, io.TextIOWrapper):
        _stream.reconfigure(newline="\r\n")
