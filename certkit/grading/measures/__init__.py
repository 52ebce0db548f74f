"""How measures are taken, one file each, named by the measure's words: `max_abs.py` takes `max abs`.

A new measure is a file here and one line in `certkit.definitions.measures`.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from certkit.grading.measures.measure_method import MeasureMethod


@cache
def method_of(measure: str) -> MeasureMethod:
    """Return what takes a measure: the class of the file's name, as `MaxAbs` in `max_abs.py`."""
    file = measure.replace(" ", "_")
    method: MeasureMethod = getattr(import_module(f"{__name__}.{file}"), file.title().replace("_", ""))()
    return method
