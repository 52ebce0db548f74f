"""The command line: one small file a command, no logic. Heavy imports wait until a command runs."""

from __future__ import annotations

import atexit
import errno
import gc
import os
import sys
import traceback
import warnings
from typing import TextIO

from certkit.cli.output_streams import end_streams, guard_streams
from certkit.errors import CertkitError, LeftOutWarning, OldFormWarning, TakenAsSaidWarning, UsageError


def _tell_remark(  # the signature of `warnings.showwarning`
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """Say a warning in one line; one of certkit's own without the place in its code."""
    from typer import echo  # noqa: PLC0415  # as in `main`

    text = f"remark: {message}"
    if not issubclass(category, (OldFormWarning, LeftOutWarning, TakenAsSaidWarning)):
        text = warnings.formatwarning(message, category, filename, lineno, line).rstrip()
    echo(text, file=file or sys.stderr)


def _words_of(error: OSError) -> str:
    """Say what could not be read or written, and what to do."""
    remedies = {
        errno.ENOSPC: "make room, or name another folder with `--out`",
        errno.EDQUOT: "make room, or name another folder with `--out`",
        errno.EROFS: "name another folder with `--out`",
        errno.EACCES: "ask for the right to it, or name another place",
        errno.EPERM: "ask for the right to it, or name another place",
        errno.ENAMETOOLONG: "take a shorter name",
        errno.ENOTDIR: "a file stands where a folder should be; name another",
        errno.EEXIST: "a file stands where a folder should be; name another",
        errno.EISDIR: "a folder stands where a file should be; name another",
        errno.ENOENT: "check the path",
    }
    place = f"{str(error.filename)[:200]}: " if error.filename else ""
    remedy = remedies.get(error.errno or 0, "check the place, and try again")
    return f"{place}{error.strerror or error}; {remedy}"


def main() -> None:
    """Run the command line and end with the contract's exit code."""
    # Imports and documents are many objects and hardly any garbage: to look for it every 700 costs 100 ms.
    gc.set_threshold(500_000)
    # No last look for it either, once the process ends: before that, others may live in it.
    atexit.register(gc.freeze)
    # Nor are pydantic's plugins wanted, which it looks for among all packages that are installed: 10 ms.
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    from typer import echo  # noqa: PLC0415  # both lines above concern it too

    from certkit.cli.commands import app_for  # noqa: PLC0415  # likewise
    from certkit.cli.completion import BASH, words_of_bash  # noqa: PLC0415  # likewise

    warnings.showwarning = _tell_remark
    guard_streams()
    if BASH.items() <= os.environ.items() and (offered := words_of_bash()) is not None:
        sys.stdout.write("\n".join(offered))
        return
    try:
        app_for(sys.argv[1:])()
    except CertkitError as error:
        for line in str(error).splitlines():
            echo(f"error: {line}", err=True)
        sys.exit(error.exit_code)
    except OSError as error:
        echo(f"error: {_words_of(error)}", err=True)
        sys.exit(UsageError.exit_code)
    except Exception:  # noqa: BLE001  # Python's own exit code for a crash would read as the verdict `fail`
        traceback.print_exc()
        echo("error: this is a fault of certkit, not of your files; please report the lines above", err=True)
        sys.exit(CertkitError.exit_code)
    except KeyboardInterrupt:
        echo("interrupted; nothing half-written is left behind", err=True)
        sys.exit(130)
    finally:
        end_streams()
