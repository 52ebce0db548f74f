"""Versions of the packages whose version can change a number or a page."""

from __future__ import annotations

import os
import re
import sys
from functools import cache

PACKAGES = ("jinja2", "numba", "numpy", "pydantic", "pymunk", "pyyaml", "weasyprint")

_FOLDER = re.compile(r"(.+)-([^-]+)\.dist-info")


@cache
def package_versions() -> dict[str, str]:
    """Return the version of each of `PACKAGES`.

    An installed package has a folder `NAME-VERSION.dist-info` (PyPA, Recording installed projects), the first
    on Python's path counts. Its name is read here because to import `importlib.metadata` and parse what lies
    in such a folder takes 15 ms; where a package has none, that is asked.

    Raises
    ------
    PackageNotFoundError
        When one is not installed.
    """
    known = _folders()
    return {name: known.get(name) or _asked(name) for name in PACKAGES}


def _folders() -> dict[str, str]:
    found: dict[str, str] = {}
    for place in sys.path:
        try:
            names = os.listdir(place or os.curdir)  # noqa: PTH208  # thrice as quick as a list of paths
        except OSError:
            continue
        for folder in names:
            match = _FOLDER.fullmatch(folder)
            if match is not None:
                found.setdefault(re.sub(r"[-_.]+", "-", match[1]).lower(), match[2])
    return found


def _asked(name: str) -> str:
    from importlib.metadata import version  # noqa: PLC0415  # see `package_versions`

    return version(name)
