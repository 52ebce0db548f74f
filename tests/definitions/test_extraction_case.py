"""A case says how its histories are read; what the format cannot use is refused at its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from certkit.definitions.extraction_case import Case
from certkit.definitions.loading.validation import read_document
from certkit.errors import DefinitionError

CASE = """case: made-up
title: Columns of a table beside a solver's file
origin: {source: made up, confidence: estimated}
histories:
  format: FORMAT
  files: [run]
  parts:
    beam: {momentum: beam_p}
"""


def test_columns_beside_a_solvers_file_are_refused_where_they_stand(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(CASE.replace("FORMAT", "ls-dyna binout"))
    with pytest.raises(
        DefinitionError, match=r"case\.yaml:8:5: `parts` is .*`ls-dyna binout`; leave it out"
    ) as error:
        read_document(path, Case)
    assert len(str(error.value).splitlines()) == 1
    path.write_text(CASE.replace("FORMAT", "tidy csv"))
    assert read_document(path, Case).histories.parts["beam"].momentum == "beam_p"


def test_a_table_has_no_rigid_bodies(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(CASE.replace("FORMAT", "tidy csv") + "  rigid bodies: {beam: {mass: 6 kg, node: n}}\n")
    with pytest.raises(DefinitionError, match=r"case\.yaml:9:\d+: `rigid bodies` are for solvers' files"):
        read_document(path, Case)
