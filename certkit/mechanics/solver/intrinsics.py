"""What compiled code needs beside numba's own: arrays seen at an address, and pymunk's C entry points.

A loop over the public API (`pymunk.batch`, force kernel, `Space.step`) takes several times as long a step,
with the same trajectories bit for bit (`tests/mechanics/solver/test_time_loop.py`). Addresses
travel as integers, so the compiled loop can be kept on disk.
"""

# llvmlite and numba's intrinsics are untyped:
# ruff: noqa: ANN401, ARG001

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from llvmlite import ir
from numba import extending
from numba import from_dtype as numba_from_dtype
from numba import types as numba_types
from numba.np import arrayobj

from certkit.mechanics.solver.kernel_arguments import KINDS, WORDS, KernelArguments

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np

types = cast("Any", numba_types)
arrays = cast("Any", arrayobj)
from_dtype = cast("Any", numba_from_dtype)

_ADDRESS = ir.IntType(64)


def intrinsic(write: Callable[..., Any]) -> Any:
    """Let compiled code call what `write` makes of a call: its signature, and the instructions for it."""
    return cast("Any", extending.intrinsic)(write)


def _function(builder: Any, address: Any, result: ir.Type, *arguments: ir.Type) -> Any:
    return builder.inttoptr(address, ir.FunctionType(result, arguments).as_pointer())


def _view(context: Any, builder: Any, kind: Any, data: Any, shape: list[Any]) -> Any:
    """Return an array in row order over memory that somebody else keeps."""
    array = arrays.make_array(kind)(context, builder)
    size = context.get_abi_sizeof(context.get_data_type(kind.dtype))
    strides = [_ADDRESS(size)]
    for extent in reversed(shape[1:]):
        strides.insert(0, builder.mul(strides[0], extent))
    arrays.populate_array(array, data=data, shape=shape, strides=strides, itemsize=size, meminfo=None)
    return array._getvalue()  # noqa: SLF001  # numba's own way


@intrinsic
def arguments_at(typing: Any, address: Any) -> Any:
    """Return the `KernelArguments` whose block stands at `address`."""
    kinds = [types.Array(from_dtype(kind), dimensions, "C") for kind, dimensions in KINDS]

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        block = builder.inttoptr(arguments[0], _ADDRESS.as_pointer())
        views = []
        for row, kind in enumerate(kinds):
            start, *shape = (
                builder.load(builder.gep(block, [_ADDRESS(WORDS * row + k)])) for k in range(1 + kind.ndim)
            )
            data = builder.inttoptr(start, context.get_data_type(kind.dtype).as_pointer())
            views.append(_view(context, builder, kind, data, shape))
        return context.make_tuple(builder, signature.return_type, views)

    return types.NamedTuple(kinds, KernelArguments)(types.int64), code


def table_reader(record: np.dtype[np.void]) -> Any:
    """Return what gives compiled code a table of records out of a pool of numbers.

    `read(pool, start, rows)` is the `rows` records from place `start` of the pool on; writing to them
    writes to the pool.
    """
    kind = types.Array(from_dtype(record), 1, "C")

    @intrinsic
    def read(typing: Any, pool: Any, start: Any, rows: Any) -> Any:
        def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            flat = arrays.make_array(pool)(context, builder, value=arguments[0])
            place = builder.gep(flat.data, [arguments[1]])
            data = builder.bitcast(place, context.get_data_type(kind.dtype).as_pointer())
            return _view(context, builder, kind, data, [arguments[2]])

        return kind(pool, types.int64, types.int64), code

    return read


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
