"""The bench: the one place where the rooms meet.

`run` a simulated test, `grade` a measured one, `compare` two, `save` what came of it. What a simulated test
does not need is imported when it is first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from certkit.bench.save import save, save_suite
from certkit.bench.setup import Setup, prepare
from certkit.bench.simulated import run, run_setup

if TYPE_CHECKING:
    from certkit.bench.comparing import compare
    from certkit.bench.exporting import export
    from certkit.bench.family import run_family
    from certkit.bench.measured import grade

_HOMES = {
    "compare": "certkit.bench.comparing",
    "export": "certkit.bench.exporting",
    "grade": "certkit.bench.measured",
    "run_family": "certkit.bench.family",
}

__all__ = [
    "Setup",
    "compare",
    "export",
    "grade",
    "prepare",
    "run",
    "run_family",
    "run_setup",
    "save",
    "save_suite",
]


def __getattr__(name: str) -> Any:  # noqa: ANN401  # a module's attributes are of any type
    """Import a name from the file it lives in."""
    if name not in _HOMES:
        raise AttributeError(f"module `certkit.bench` has no `{name}`")
    return getattr(import_module(_HOMES[name]), name)
