"""pymunk's C entry points, called from compiled code by address.

A public-API loop (`pymunk.batch`, force kernel, `Space.step`) takes 26 µs a step with 54 bodies, the
compiled loop 12 µs, with the same trajectories bit for bit (`tests/mechanics/test_loop.py`). Addresses
travel as integers, so the compiled loop can be cached on disk.
"""

# llvmlite and numba's intrinsics are untyped:
# ruff: noqa: ANN401, ARG001

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

_ADDRESS = ir.IntType(64)


def _function(builder: Any, address: Any, result: ir.Type, *arguments: ir.Type) -> Any:
    return builder.inttoptr(address, ir.FunctionType(result, arguments).as_pointer())


@intrinsic
def call_each(typing: Any, each: Any, space: Any, visit: Any, data: Any) -> Any:
    """`each(space, visit, data)`: cpSpaceEachBody, all four given as addresses."""
    address = types.int64

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        function = _function(builder, arguments[0], ir.VoidType(), _ADDRESS, _ADDRESS, _ADDRESS)
        builder.call(function, arguments[1:])
        return context.get_dummy_value()

    return types.void(address, address, address, address), code


@intrinsic
def call_step(typing: Any, step: Any, space: Any, length: Any) -> Any:
    """`step(space, length)`: cpSpaceStep."""

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        function = _function(builder, arguments[0], ir.VoidType(), _ADDRESS, ir.DoubleType())
        builder.call(function, arguments[1:])
        return context.get_dummy_value()

    return types.void(types.int64, types.int64, types.float64), code


@intrinsic
def call_impulse(typing: Any, impulse: Any, constraint: Any) -> Any:
    """`impulse(constraint)`: cpConstraintGetImpulse, the size of the last step's impulse."""

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        function = _function(builder, arguments[0], ir.DoubleType(), _ADDRESS)
        return builder.call(function, arguments[1:])

    return types.float64(types.int64, types.int64), code
