"""How the laws are compiled: each for itself, inlined into the kernel by LLVM; only the kernel is cached on disk."""

from __future__ import annotations

from collections.abc import Callable
from typing import ParamSpec, TypeVar, cast

from numba import njit

P = ParamSpec("P")
R = TypeVar("R")


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a law with numba; divisions follow IEEE rules, nothing is reordered (runs repeat bit for bit)."""
    return cast("Callable[P, R]", njit(error_model="numpy")(function))
