"""The bench: the one place where the rooms meet.

`run` a simulated test, `grade` a measured one, `compare` two, `save` what came of it.
"""

from certkit.bench.compare import compare
from certkit.bench.export import export
from certkit.bench.family import run_family
from certkit.bench.measured import grade
from certkit.bench.save import save, save_suite
from certkit.bench.setup import Setup, prepare
from certkit.bench.simulated import run, run_setup

__all__ = [
    "Setup",
    "compare",
    "export",
    "grade",
    "prepare",
    "run",
    "run_family",
    "run_setup",
    "save",
    "save_suite",
]
