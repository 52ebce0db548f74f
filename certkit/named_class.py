"""One class in one file: how a registry finds a class by its words, `max abs` as `MaxAbs` in `max_abs.py`."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def file_name(words: str) -> str:
    """Return the name of the file that words name: `ls-dyna binout` is `ls_dyna_binout`."""
    return words.replace(" ", "_").replace("-", "_")


def named_class(package: str, words: str) -> Any:  # noqa: ANN401  # whoever asks knows the base class
    """Return the class of a file of a package.

    Parameters
    ----------
    package : str
        Such as `certkit.grading.measures`.
    words : str
        The file's name, with spaces, hyphens or underscores between its words.

    Raises
    ------
    LookupError
        When a registry has words without a file, or the file has no class of its name.
    """
    file = file_name(words)
    name = file.title().replace("_", "")
    place = f"{package.replace('.', '/')}/{file}.py"
    try:
        module = import_module(f"{package}.{file}")
    except ModuleNotFoundError as error:
        if error.name != f"{package}.{file}":
            raise
        raise LookupError(f"`{words}` is listed, but there is no {place} with a class {name}") from None
    if not hasattr(module, name):
        raise LookupError(f"`{words}` is listed, but {place} has no class {name}")
    return getattr(module, name)
