"""A first grouping of parts, from their positions and the names of their contacts."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

from certkit.bench.propose_case import proposed_case
from certkit.definitions.extraction_case import Case
from certkit.definitions.loading.library import load
from certkit.errors import DataError
from certkit.exchange.fe.histories import ContactHistory, PartHistories, PartHistory, SpringHistory
from certkit.exchange.fe.reading import read_case_data
from certkit.identification.five_steps import extract
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


def test_a_steep_edge_that_is_called_a_hood_is_one() -> None:
    case = load("case", EXAMPLES / "front1/case.yaml").document
    data = read_case_data(case.histories, EXAMPLES / "front1")
    steep = {name: replace(face, slope=0.5) for name, face in data.faces.items()}
    found = propose(data.histories, steep)
    assert {found.groups[name][0] for name in ("H1", "H2")} == {"hood"}
    assert ("F7", "H1") not in [path.between for path in found.paths]


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


def test_where_no_spring_was_recorded_the_last_group_stands_on_the_ground() -> None:
    histories = replace(bumper(beam=0.0, foam=0.0, skin=0.0, ball=66.6), springs={})
    last = propose(histories, {}).paths[-1]
    assert (last.between, last.law) == (("beam", "ground"), False)


def test_places_that_the_solver_tells_stand_in_for_a_table_of_groups() -> None:
    histories = bumper(beam=0.0, foam=0.0, skin=0.0, ball=66.6)
    spots = {"skin": 0.0, "foam": 0.05, "beam": 0.1, "ball": -0.05}
    parts = {name: replace(part, start=(spots[name], 0.0, 0.5)) for name, part in histories.parts.items()}
    contacts = {name: c for name, c in histories.contacts.items() if name != "foam-beam"}
    found = propose(replace(histories, parts=parts, contacts=contacts), {})
    foam = next(path for path in found.paths if path.between == ("foam", "beam"))
    assert "the nearest group behind that is held" in foam.because


def test_a_proposal_of_the_simple_bumper_can_be_extracted_as_it_is(tmp_path: Path) -> None:
    text = (EXAMPLES / "bumper-reference/case.yaml").read_text("utf-8").partition("groups:")[0]
    (tmp_path / "bare.yaml").write_text(text, "utf-8")
    proposal = proposed_case(tmp_path / "bare.yaml", data=EXAMPLES / "bumper-reference")
    (tmp_path / "case.yaml").write_text(proposal, "utf-8")
    result = extract(load("case", tmp_path / "case.yaml").document, EXAMPLES / "bumper-reference")
    assert result.closed
    assert [path.name for path in result.paths] == [
        "impactor – fascia",
        "fascia – foam",
        "foam – back",
        "back – ground",
    ]


def test_where_nothing_moves_there_is_no_impactor() -> None:
    with pytest.raises(DataError, match="no part moves at the start"):
        propose(bumper(beam=0.0, foam=0.0, skin=0.0, ball=0.0), {})


def test_a_case_without_groups_says_how_to_come_by_them() -> None:
    case = front()[0].model_copy(update={"groups": {}, "paths": []})
    with pytest.raises(DataError, match="--propose"):
        build_graph(case, bumper(ball=1.0))
