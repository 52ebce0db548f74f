"""One class in one file: how a registry finds a class by its words, `max abs` as `MaxAbs` in `max_abs.py`."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def named_class(package: str, words: str) -> Any:  # noqa: ANN401  # whoever asks knows the base class
    """Return the class of a file of a package.

    Parameters
    ----------
    package : str
        Such as `certkit.grading.measures`.
    words : str
        The file's name, with spaces or underscores between its words.
    """
    file = words.replace(" ", "_")
    return getattr(import_module(f"{package}.{file}"), file.title().replace("_", ""))
