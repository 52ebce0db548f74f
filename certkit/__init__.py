"""certkit: a regulatory certification bench for the Flex-PLI legform.

The few names that a notebook needs; each is imported when first used, so that `import certkit` costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from certkit._version import __version__

if TYPE_CHECKING:
    from certkit.bench import compare, grade, run
    from certkit.definitions.loading.library import load
    from certkit.reporting import render
    from certkit.studies.study_findings import study

_HOMES = {
    "compare": "certkit.bench",
    "grade": "certkit.bench",
    "load": "certkit.definitions.loading.library",
    "render": "certkit.reporting",
    "run": "certkit.bench",
    "study": "certkit.studies.study_findings",
}

__all__ = ["__version__", "compare", "grade", "load", "render", "run", "study"]


def __getattr__(name: str) -> Any:  # noqa: ANN401  # a module's attributes are of any type
    """Import a name from the room it lives in."""
    if name not in _HOMES:
        raise AttributeError(f"module `certkit` has no `{name}`; it hands on {', '.join(sorted(_HOMES))}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    """List what the module hands on."""
    return sorted(__all__)
