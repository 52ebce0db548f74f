"""One procedure over every leg of a family."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from certkit.bench.run_family import run_family
from certkit.bench.run_simulation import run

if TYPE_CHECKING:
    from pathlib import Path

FAMILY = """
family: flex-pli-gtr
title: Two legs of this test
legform: flex-pli-gtr
members:
  - {id: soft, values: {knee.ligaments.MCL.stiffness: 50 N/mm}}
  - {id: stiff, values: {knee.ligaments.MCL.stiffness: 70 N/mm}}
"""


def test_a_result_over_a_family_spreads_over_its_legs_and_keeps_the_nominal_value(tmp_path: Path) -> None:
    folder = tmp_path / "models" / "legforms" / "families"
    folder.mkdir(parents=True)
    (folder / "flex-pli-gtr.yaml").write_text(FAMILY, encoding="utf-8")
    found = run_family("inverse", library=tmp_path, overrides={"rig.ram.speed": "10 m/s"})
    alone = run("inverse", overrides={"rig.ram.speed": "10 m/s"}, refine=False)
    assert found.criteria["MCL"].value == alone.criteria["MCL"].value
    soft, stiff = (
        run(
            "inverse",
            overrides={"rig.ram.speed": "10 m/s", "legform.knee.ligaments.MCL.stiffness": stiffness},
            refine=False,
        )
        .criteria["MCL"]
        .value
        for stiffness in ("50 N/mm", "70 N/mm")
    )
    spread = found.criteria["MCL"].spread
    assert spread is not None
    assert spread.members == 3
    assert (spread.minimum, spread.maximum) == pytest.approx((stiff, soft))
