"""The bench: the one place where the rooms meet.

`run` a simulated test, `grade` a measured one, `compare` two, `save` what came of it. What a simulated test
does not need is imported when it is first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from certkit.bench.run_simulation import run, run_setup
from certkit.bench.save import save, save_suite
from certkit.bench.setup import Setup, prepare

if TYPE_CHECKING:
    from certkit.bench.compare import compare
    from certkit.bench.export import export
    from certkit.bench.grade_measurement import grade
    from certkit.bench.run_family import run_family

_HOMES = {
    "compare": "certkit.bench.compare",
    "export": "certkit.bench.export",
    "grade": "certkit.bench.grade_measurement",
    "run_family": "certkit.bench.run_family",
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
