"""Inputs damaged by the hundred: none passes in silence or ends in a traceback or a wrong exit code."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from support.damaged_inputs.corpus import FORMATS, SEED, shipped_recording, tried
from support.damaged_inputs.measured_files import mme, table
from support.damaged_inputs.variant import BAD

if TYPE_CHECKING:
    from pathlib import Path

EVERY = {"ISO-MME": 5, "CSV": 5, "YAML": 7, "JSON": 2}
"""Every which variant is tried of the formats that have most."""


def faults(name: str) -> list[str]:
    found = list(tried(SEED, formats=(name,), every=EVERY))
    assert found
    return [
        f"{item.outcome.value}: {item.variant.format}, {item.variant.kind}: {item.variant.name}: {item.said}"
        for item in found
        if item.outcome in BAD
    ]


@pytest.mark.slow
@pytest.mark.parametrize("name", FORMATS)
def test_no_damage_of_the_fixed_seed_goes_by_in_silence(name: str):
    if name == "PDF":
        pytest.importorskip("pikepdf")
    if name == "binout":
        pytest.importorskip("lasso")
    assert not faults(name)


def test_the_intact_input_passes(tmp_path: Path):
    for make in (mme, table):
        assert make(shipped_recording()).grade(tmp_path).passed
