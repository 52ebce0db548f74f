"""The folders that come with certkit: inside an installed package, at the top of a checkout otherwise."""

from __future__ import annotations

from functools import lru_cache
from importlib.resources import files
from pathlib import Path


@lru_cache(maxsize=1)
def shipped_root() -> Path:
    """Return the folder that holds `procedures/`, `corridors/`, `models/` and the others."""
    package = Path(str(files("certkit")))
    inside = package / "shipped"
    return inside if inside.is_dir() else package.parent
