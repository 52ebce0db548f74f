"""How functions of the time loop become machine code: with numba, imported only when one is compiled."""

from __future__ import annotations

from functools import cache, cached_property
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar, cast

if TYPE_CHECKING:
    from collections.abc import Callable

P = ParamSpec("P")
R = TypeVar("R")


class _NotCompiledYet:
    """A function that numba meets when it compiles a caller; until then numba stays out of the process."""

    def __init__(self, function: Callable[..., object]) -> None:
        self.function = function
        self.__doc__ = function.__doc__

    @cached_property
    def _dispatcher(self) -> Any:  # noqa: ANN401  # numba has no types
        return numba_compiled(self.function)

    @property
    def _numba_type_(self) -> Any:  # noqa: ANN401  # likewise; this is the name that numba asks for
        return self._dispatcher._numba_type_


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """Mark a function as part of the time loop; only other compiled functions can call it."""
    return cast("Callable[P, R]", _NotCompiledYet(function))


def numba_compiled(function: Callable[..., object]) -> Any:  # noqa: ANN401  # likewise
    """Hand a function to numba, by IEEE rules and without reordering: runs repeat bit for bit.

    Without wrappers for Python it compiles faster. Without counted references (all memory comes from outside)
    it runs three times as fast, and needs nothing of numba's to run. Inlined into one function, the loop does
    not pass its two dozen tables from call to call.
    """
    import numba  # noqa: PLC0415  # 0.7 s that a warm run does not pay

    njit = cast("Any", numba.njit)
    return njit(
        error_model="numpy",
        no_cpython_wrapper=True,
        no_cfunc_wrapper=True,
        forceinline=True,
        **_without_counted_references(),
    )(function)


@cache
def _without_counted_references() -> dict[str, bool]:
    """Return numba's private option for it, or nothing where that is gone: such a loop needs numba to run."""
    import numba  # noqa: PLC0415  # as above

    option = {"_nrt": False}
    try:
        cast("Any", numba.njit)(**option)(lambda: None).compile(())
    except KeyError:
        return {}
    return option
