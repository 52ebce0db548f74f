"""The same certificates made in other environments: processors, locales, interpreters, folders."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
MASKED = ",".join(f"-{name}" for name in ("AVX512F", "AVX512VL", "AVX2", "FMA", "FMA4", "AVX"))
C_LIBRARY = {"GLIBC_TUNABLES": f"glibc.cpu.hwcaps={MASKED}"}
NUMPY = {"NPY_DISABLE_CPU_FEATURES": "AVX512F AVX512_SKX AVX2 FMA3"}
LLVM = {"NUMBA_CPU_FEATURES": "-fma,-avx2,-avx512f,-avx512vl,-avx512dq,-avx512bw,-avx512cd"}
ONE_THREAD = {f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "NUMBA", "MKL")}

SCRIPT = """
import json, os, platform, sys, warnings
warnings.simplefilter("ignore")
import certkit, numba, numpy, pydantic, scipy, pymunk
from pathlib import Path
examples = Path(sys.argv[1]) / "examples"
ids = [certkit.run(name, refine=name == "inverse").id for name in sys.argv[2:]]
data = examples / "measured"
ids.append(certkit.grade("pendulum", data / "FLX-0007-pendulum.zip", laboratory=data / "lab.yaml").id)
ids.append(certkit.extract(examples / "extract/bumper-reference/case-tidy.yaml", procedure=None).id)
named = [numpy, numba, scipy, pydantic, pymunk]
versions = [f"Python {platform.python_version()}"]
versions += [f"{each.__name__} {getattr(each, '__version__', None) or each.version}" for each in named]
print(json.dumps([ids, ", ".join(versions)]))
"""
PROCEDURES = ("static-femur", "static-knee", "pendulum", "inverse")


class Found(NamedTuple):
    """Ids of the certificates, and what made them."""

    ids: tuple[str, ...]
    versions: str


@dataclass(frozen=True)
class Environment:
    """One way to start certkit.

    Parameters
    ----------
    name : str
    variables : mapping of str to str
        Of the environment.
    before : tuple of str
        Command that starts the interpreter.
    options : tuple of str
        Of the interpreter.
    folder : str
        Name of the working folder.
    python : str
        Another interpreter.
    umask : int
    """

    name: str
    variables: Mapping[str, str] = field(default_factory=dict)
    before: tuple[str, ...] = ()
    options: tuple[str, ...] = ()
    folder: str = "work"
    python: str = ""
    umask: int = 0o022

    @property
    def settings(self) -> str:
        """What is done, for a table."""
        words = [f"{name}={value}" for name, value in self.variables.items()]
        words += [*self.before, *self.options]
        return f"`{' '.join(words)}`" if words else ""


ENVIRONMENTS = (
    Environment("as it is"),
    Environment("C library without FMA, AVX2, AVX-512", C_LIBRARY),
    Environment("numpy without FMA, AVX2, AVX-512", NUMPY),
    Environment("compiled without FMA, AVX2, AVX-512", LLVM),
    Environment("compiled for any processor", {"NUMBA_CPU_NAME": "generic"}),
    Environment("all of them without", {**C_LIBRARY, **NUMPY, **LLVM, "OPENBLAS_CORETYPE": "Prescott"}),
    Environment("compiled with little optimisation", {"NUMBA_OPT": "1"}),
    Environment("kernels of another processor in BLAS", {"OPENBLAS_CORETYPE": "Haswell"}),
    Environment("one thread", ONE_THREAD),
    Environment("one core", before=("taskset", "-c", "0")),
    Environment("locale C, ASCII", {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONIOENCODING": "ascii"}),
    Environment("time in Tokyo", {"TZ": "Asia/Tokyo"}),
    Environment("time in Newfoundland", {"TZ": "America/St_Johns"}),
    Environment("hash seed 0", {"PYTHONHASHSEED": "0"}),
    Environment("hash seed 4242", {"PYTHONHASHSEED": "4242"}),
    Environment("without assertions", options=("-OO",)),
    Environment("files for the owner alone", umask=0o077),
    Environment("a folder of another name", folder="Prüf stand/Ω 試験 'x'"),
    Environment("no kept machine code", {"CERTKIT_CACHE": "/dev/null/none"}),
    Environment("memory filled with a pattern", {"MALLOC_PERTURB_": "165"}),
)


def ids_in(environment: Environment, root: Path = ROOT) -> Found:
    """Make the certificates there."""
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder, environment.folder)
        work.mkdir(parents=True)
        script = Path(folder, "ids.py")
        script.write_text(SCRIPT, encoding="utf-8")
        python = environment.python or sys.executable
        words = [*environment.before, python, *environment.options, str(script), str(root), *PROCEDURES]
        done = subprocess.run(
            words,
            cwd=work,
            env={**os.environ, "PYTHONPATH": str(root), **environment.variables},
            capture_output=True,
            text=True,
            check=False,
            umask=environment.umask,
        )
        assert done.returncode == 0, f"{environment.name}: {done.stderr}"
        ids, versions = json.loads(done.stdout.splitlines()[-1])
        return Found(tuple(ids), versions)
