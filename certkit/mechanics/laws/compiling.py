"""How the laws are compiled: each for itself; only the kernel that calls them is cached on disk."""

from __future__ import annotations

from typing import TYPE_CHECKING, ParamSpec, TypeVar, cast

from numba import njit

if TYPE_CHECKING:
    from collections.abc import Callable

P = ParamSpec("P")
R = TypeVar("R")


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a law with numba, by IEEE rules and without reordering: runs repeat bit for bit."""
    # Called from the kernel alone: without wrappers for Python they compile in five sixths of the time.
    lean = njit(error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)
    return cast("Callable[P, R]", lean(function))
