"""A first grouping of parts, from their positions and the names of their contacts."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from certkit.definitions.extraction_case import Case
from certkit.definitions.loading.library import load
from certkit.errors import DataError
from certkit.exchange.fe.histories import ContactHistory, PartHistories, PartHistory, SpringHistory
from certkit.exchange.fe.reading import read_case_data
from certkit.identification.grouping import build_graph
from certkit.identification.grouping_proposal import Proposal, propose

EXAMPLES = Path(__file__).parents[2] / "examples/extract"
TIME = np.linspace(0.0, 0.01, 5)
WHOLE_FASCIA = {"F3 – E3", "H1 – E4"}
"""Their contacts are recorded for the fascia as a whole."""


@cache
def front() -> tuple[Case, Proposal]:
    case = load("case", EXAMPLES / "front1/case.yaml").document
    data = read_case_data(case.histories, EXAMPLES / "front1")
    return case, propose(data.histories, data.faces)


def test_groups_are_those_that_an_engineer_made() -> None:
    case, found = front()
    assert {name: kind for name, (kind, _) in found.groups.items()} == {
        name: group.kind for name, group in case.groups.items()
    }


def test_all_paths_are_found_but_those_that_no_name_tells() -> None:
    case, found = front()
    wanted = {path.name: path for path in case.paths}
    got = {" – ".join(path.between): path for path in found.paths}
    assert wanted.keys() - got.keys() == WHOLE_FASCIA
    assert not got.keys() - wanted.keys()
    assert all(path.law == wanted[name].law for name, path in got.items())
    assert {"contact hood_fascia", "contact fascia_beam"} <= set(found.left_over)


def bumper(**momenta: float) -> PartHistories:
    still = np.zeros_like(TIME)
    return PartHistories(
        TIME,
        {name: PartHistory(1.0, still + value, still) for name, value in momenta.items()},
        contacts={
            "foam-beam": ContactHistory(still),
            "skin-foam": ContactHistory(still),
            "ball-skin": ContactHistory(still),
        },
        springs={"beam": SpringHistory(still)},
        source="bumper.csv",
    )


def test_paths_lead_away_from_what_moves_and_what_it_touches_is_fascia() -> None:
    found = propose(bumper(beam=0.0, foam=0.0, skin=0.0, ball=66.6), {})
    assert [path.between for path in found.paths] == [
        ("ball", "skin"),
        ("skin", "foam"),
        ("foam", "beam"),
        ("beam", "ground"),
    ]
    assert found.groups["ball"][0] == "impactor"
    assert found.groups["skin"][0] == "fascia"


def test_where_nothing_moves_there_is_no_impactor() -> None:
    with pytest.raises(DataError, match="no part moves at the start"):
        propose(bumper(beam=0.0, foam=0.0, skin=0.0, ball=0.0), {})


def test_a_case_without_groups_says_how_to_come_by_them() -> None:
    case = front()[0].model_copy(update={"groups": {}, "paths": []})
    with pytest.raises(DataError, match="--propose"):
        build_graph(case, bumper(ball=1.0))
