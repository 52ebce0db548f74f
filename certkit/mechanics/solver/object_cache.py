"""The compiled loop as a function, with or without numba.

Importing numba takes 0.3 s, with scipy installed 0.7 s; a run of 60 ms is simulated in 0.01 s. So what numba
has compiled is kept as an object file in the user's cache, and llvmlite alone loads it from there, in 0.02 s.
The file's name is a digest of all that its content depends on. It is loaded only from a folder in which
nobody but the user can write (`certkit.files.own_folder`). Whatever is unusual, numba compiles again.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import platform
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from llvmlite import binding as llvm

from certkit.errors import RunError
from certkit.files.own_folder import OwnFolder
from certkit.mechanics.solver.kernel_arguments import KernelArguments, block

if TYPE_CHECKING:
    from collections.abc import Callable

Entry: TypeAlias = "Callable[[int], tuple[int, int]]"
"""The loop as machine code: from the address of the arguments' block to an error code and the status."""

FOLDER = Path(__file__).parents[1]
SOURCES = ("compiling.py", "records.py", "solver/*.py", "force_laws/*.py")

C_LIBRARY = frozenset(
    {"acos", "asin", "atan", "atan2", "cos", "exp", "log", "pow", "sin", "sincos", "sqrt", "tan", "tanh"}
)
"""All that the object file may ask for by name. LLVM ends the process when it cannot find a name."""


class Code(NamedTuple):
    """An object file, and the name of the loop's function in it."""

    name: str
    content: bytes


@cache
def loop() -> Callable[[KernelArguments], int]:
    """Return the compiled time loop, which takes `KernelArguments` and returns FINISHED or RAN_AWAY.

    Raises
    ------
    RunError
        By the loop that is returned: when compiled code reports an error of its own.
    """
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    folder = _cache()
    name = f"{_digest()}.o"
    code = _read(folder, name)
    if code is None:
        if folder is not None:
            _tell(f"compiling the solver for this machine: once, some ten seconds; kept in {folder.path}")
        code = compile_loop()
        if code is not None and folder is not None:
            _keep(folder, name, code)
    entry = (by_llvm(code) if code else None) or by_numba()

    def run_loop(run: KernelArguments) -> int:
        words = block(run)
        status, outcome = entry(words.ctypes.data)
        if status:
            raise RunError(f"the compiled loop stopped with code {status}; please report this fault")
        return outcome

    return run_loop


def cache_folder() -> Path:
    """Return where object files are kept: `CERTKIT_CACHE`, else `certkit` in the user's cache folder.

    Without a home folder this is no whole path: then nothing is kept.
    """
    own = os.environ.get("CERTKIT_CACHE")
    if own:
        return Path(own).absolute()
    from platformdirs import user_cache_path  # noqa: PLC0415  # 10 ms that are not always needed

    try:
        return user_cache_path("certkit", appauthor=False)
    except RuntimeError:  # a user whom the system does not know
        return Path("~", ".cache", "certkit")


def _cache() -> OwnFolder | None:
    """Return the cache, or None, with a line that says why, where there is no safe place for one."""
    folder = cache_folder()
    try:
        return OwnFolder(folder)
    except OSError as error:
        why = error.strerror or str(error)
        _tell(f"compiling the solver, some ten seconds; it cannot be kept in {folder} ({why})")
        return None


def compile_loop() -> Code | None:
    """Compile with numba; None where it gives no object file that can be kept: see `object_code`."""
    from numba import types  # noqa: PLC0415  # 0.7 s that a warm run does not pay

    from certkit.mechanics.compiling import numba_compiled  # noqa: PLC0415  # likewise
    from certkit.mechanics.solver.kernel import time_loop  # noqa: PLC0415  # likewise

    dispatcher = numba_compiled(time_loop)
    dispatcher.compile((types.int64,))
    result = dispatcher.overloads[types.int64,]
    return object_code(result.library, result.fndesc.llvm_func_name)


def object_code(library: Any, name: str) -> Code | None:  # noqa: ANN401  # numba has no types
    """Return the object file of a compiled function; None where it could not be run without numba.

    Numba has no public way to an object file, so private names are used while they are there. Without them
    the loop is compiled again in every process, by the public way (`by_numba`).

    Parameters
    ----------
    library : numba's code library
    name : str
        Of the function in it.
    """
    try:
        module = library._final_module  # noqa: SLF001  # see above
        emit = library._codegen._tm.emit_object  # noqa: SLF001  # likewise
    except AttributeError as error:
        _not_kept(f"this numba gives no object file: {error}")
        return None
    asked = {f.name for f in module.functions if f.is_declaration and not f.name.startswith("llvm.")}
    if not asked <= C_LIBRARY or len(list(module.get_function(name).arguments)) != 3:
        _not_kept(f"with this numba it needs {', '.join(sorted(asked - C_LIBRARY)) or 'other arguments'}")
        return None
    return Code(name, emit(module))


def _not_kept(why: str) -> None:
    """Say that runs are slower from now on."""
    _tell(f"the compiled solver cannot be kept, every process compiles it anew ({why})")


def by_llvm(code: Code) -> Entry | None:
    """Load an object file; None where LLVM cannot.

    Numba's functions return a status, and their value through their first argument.
    """
    try:
        target = llvm.Target.from_triple(llvm.get_process_triple())
        engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), target.create_target_machine(jit=True))
        engine.add_object_file(llvm.ObjectFileRef.from_data(code.content))
        engine.finalize_object()
    except RuntimeError:
        return None
    place = engine.get_function_address(code.name)
    if not place:
        return None
    function = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64)(place)

    def entry(address: int) -> tuple[int, int]:
        value, exception = ctypes.c_int64(), ctypes.c_void_p()
        status = function(ctypes.addressof(value), ctypes.addressof(exception), address)
        return status, value.value

    entry.engine = engine  # type: ignore[attr-defined]  # it owns the memory that the code stands in
    return entry


def by_numba() -> Entry:
    """Compile for use in this process, by numba's own way in."""
    from numba import njit  # noqa: PLC0415  # as above

    from certkit.mechanics.solver.kernel import time_loop  # noqa: PLC0415  # likewise

    compiled = njit("int64(int64)", error_model="numpy")(time_loop)
    return lambda address: (0, int(compiled(address)))


def _digest() -> str:
    """Return what changes when anything does that the machine code depends on."""
    features = llvm.get_host_cpu_features()
    settings = sorted((name, value) for name, value in os.environ.items() if name.startswith("NUMBA_"))
    host = (sys.platform, platform.machine(), llvm.get_host_cpu_name(), features.flatten())
    programs = (_numba_version(), llvm.llvm_version_info, sys.version_info[:2])
    digest = hashlib.sha256(repr((host, programs, settings)).encode())
    for pattern in SOURCES:
        for source in sorted(FOLDER.glob(pattern)):
            digest.update(source.read_bytes())
    return digest.hexdigest()


def _numba_version() -> bytes:
    """Return the file in which numba says its version: quicker read than through its metadata."""
    found = find_spec("numba")
    if found is None or found.origin is None:
        raise RunError("numba is not installed; install certkit with its dependencies")
    return Path(found.origin).with_name("_version.py").read_bytes()


def _keep(folder: OwnFolder, name: str, code: Code) -> None:
    """Write down name and object file. Where that is impossible, go on."""
    try:
        folder.write(name, code.name.encode() + b"\n" + code.content)
    except OSError as error:
        _tell(f"the compiled solver could not be kept ({error}); the next run compiles again")


def _read(folder: OwnFolder | None, name: str) -> Code | None:
    """Return what `_keep` wrote, or None where there is none or it is not as it was written."""
    data = folder.read(name) if folder is not None else None
    if data is None:
        return None
    symbol, _, rest = data.partition(b"\n")
    return Code(symbol.decode(), rest)


def _tell(message: str) -> None:
    """Say something on standard error before a long silence, also where nobody watches and from Python."""
    print(message, file=sys.stderr, flush=True)  # noqa: T201  # see above
