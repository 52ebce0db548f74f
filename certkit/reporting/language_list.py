"""Which languages there are: the files of `certkit.reporting.languages`, by their codes (ISO 639-1)."""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules

FOLDER = "certkit.reporting.languages"


def languages() -> list[str]:
    """Return the codes of all languages there are, in alphabetical order."""
    return sorted(module.name for module in iter_modules(import_module(FOLDER).__path__))
