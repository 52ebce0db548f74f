"""How measures are taken, one file each, named by the measure's words: `max_abs.py` takes `max abs`.

A new measure is a file here and one line in `certkit.definitions.measures`.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from certkit.named_class import named_class

if TYPE_CHECKING:
    from certkit.grading.measures.measure_method import MeasureMethod


@cache
def method_of(measure: str) -> MeasureMethod:
    """Return what takes a measure: the class of the file's name, as `MaxAbs` in `max_abs.py`."""
    method: MeasureMethod = named_class(__name__, measure)()
    return method
