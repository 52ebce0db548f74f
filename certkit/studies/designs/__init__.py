"""Designs of a study, one file each, named by the design's words: `latin_hypercube.py`.

A design says where in the space of its factors a study puts its runs, the same ones for the same seed, and
what is read off them. A new one is a file here and one line in `certkit.definitions.study.DESIGNS`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.named_class import named_class

if TYPE_CHECKING:
    from certkit.studies.designs.study_design import StudyDesign


def design_of(kind: str) -> StudyDesign:
    """Return the design of that kind: the class of the file's name, as `OneAtATime` in `one_at_a_time.py`."""
    found: StudyDesign = named_class(__name__, kind)()
    return found
