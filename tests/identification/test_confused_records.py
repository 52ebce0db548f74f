"""Cases whose records contradict each other: nodes, fronts, names and channels that cannot be of one run."""

from __future__ import annotations

import json
from types import SimpleNamespace
from typing import TYPE_CHECKING, cast

import numpy as np
import pytest

from certkit.bench.channel_checks import channel_checks, channel_remarks
from certkit.definitions.loading.library import load
from certkit.errors import DataError
from certkit.exchange.fe import FrontData, PartHistories, PartHistory, read_case_data
from certkit.exchange.fe.plausible_motion import require_plausible
from certkit.exchange.fe.plausible_nodes import node_remarks
from certkit.identification.first_steps import FirstSteps, first_steps, missing_impactor
from certkit.identification.five_steps import extract
from certkit.identification.grouping import build_graph
from certkit.identification.record_names import misnamed_records
from certkit.identification.vehicle_file import vehicle_text
from tests.support.changed_fronts import copied, turn_columns

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from certkit.mechanics import Simulation

NODES, GROUPS = "animation_1ms.csv", "vehicle_groups.csv"


@pytest.fixture
def case(tmp_path: Path) -> Path:
    return copied(tmp_path)


def steps_of(case: Path) -> FirstSteps:
    document = load("case", case).document
    return first_steps(document, read_case_data(document.histories, case.parent))


def scaled(factor: float) -> Callable[[float], float]:
    return lambda value: factor * value


@pytest.mark.parametrize(
    ("file", "columns", "by", "said"),
    [
        (NODES, "[xz]_mm", 1e-3, "moves by 64.94 mm, its nodes by 0.06"),
        (NODES, "time_ms", 1e-3, "last 60.48 ms, the motion of the nodes ends at 0.06 ms"),
        (NODES, "x_mm", -1.0, "its nodes by 62.78 mm, the other way"),
        (NODES, "z_mm", 1e-3, "no node stands at the height of its part's face"),
        (GROUPS, "F4.*frontx_mm", -1.0, "front of part `F4_bumper_centre` moves by .* the other way"),
        (GROUPS, ".*frontx_mm", 1e-3, "front of part `F1_spoiler_lip` moves by 0.06494 mm, its centre"),
    ],
)
def test_nodes_and_fronts_that_cannot_be_of_the_run_are_refused(
    case: Path, file: str, columns: str, by: float, said: str
) -> None:
    turn_columns(case.parent / file, columns, scaled(by))
    with pytest.raises(DataError, match=said):
        steps_of(case)


def test_nodes_are_refused_with_the_name_of_their_file(case: Path) -> None:
    turn_columns(case.parent / NODES, "x_mm", scaled(-1.0))
    with pytest.raises(DataError, match=NODES):
        steps_of(case)


@pytest.mark.parametrize("share", [0.04, -0.04])
def test_the_centre_of_a_long_hood_may_stay_where_its_edge_moves(share: float) -> None:
    time = np.arange(0.0, 0.06, 1e-3)
    edge = 0.05 * np.sin(np.pi * time / 0.06)
    centre = share * edge
    hood = PartHistory(mass=1.0, momentum=np.gradient(centre, time), displacement=centre, front=edge)
    require_plausible(PartHistories(time=time, parts={"hood": hood}))


def remarks(case: Path) -> list[str]:
    data = read_case_data(load("case", case).document.histories, case.parent)
    assert data.motion is not None
    return node_remarks(data.motion, data.histories, data.faces)


def test_nodes_of_the_run_call_for_no_remark(case: Path) -> None:
    assert remarks(case) == []


def test_a_face_without_nodes_and_nodes_that_end_early_are_named(case: Path) -> None:
    path = case.parent / NODES
    head, *rows = path.read_text().splitlines()
    rows = [r for r in rows if ",F4_bumper_centre," not in r and float(r.split(",")[0]) <= 20.0]
    path.write_text("\n".join([head, *rows]) + "\n")
    said = remarks(case)
    assert any("ends at 20 ms, the histories at 60.48 ms" in words for words in said)
    assert "the motion of the nodes has none of `F4_bumper_centre`: such a face stays flat" in said


def test_nodes_that_end_before_a_face_moves_say_nothing_against_it(case: Path) -> None:
    path = case.parent / NODES
    head, *rows = path.read_text().splitlines()
    path.write_text("\n".join([head, *(r for r in rows if float(r.split(",")[0]) <= 9.0)]) + "\n")
    assert not [words for words in remarks(case) if "H1" in words]


def test_nodes_on_another_clock_are_warned_of(case: Path) -> None:
    turn_columns(case.parent / NODES, "time_ms", lambda t: t + 5.0)
    assert [words for words in remarks(case) if "on one clock?" in words]


def test_a_table_of_another_front_is_told_by_where_the_nodes_begin(case: Path) -> None:
    path = case.parent / "groups_table.csv"
    text = path.read_text()
    path.write_text(text.replace(",445,515,", ",745,815,"))
    said = remarks(case)
    assert [words for words in said if "`F4_bumper_centre`: its nodes begin 445 to 497.5 mm" in words]


def test_outlines_in_another_unit_are_refused(case: Path) -> None:
    path = case.parent / "params.json"
    lines = {k: v for k, v in json.loads(path.read_text()).items() if k.endswith("_poly_x_z")}
    path.write_text(json.dumps({k: [[x / 1e3, z / 1e3] for x, z in line] for k, line in lines.items()}))
    with pytest.raises(DataError, match="no outline reaches the height of any face"):
        steps_of(case)


def test_a_front_told_by_places_moves_as_one_told_by_displacements(case: Path) -> None:
    as_told = steps_of(case).displacements["F1"]
    turn_columns(case.parent / GROUPS, "F1.*frontx_mm", lambda x: x + 52.5)
    steps = steps_of(case)
    assert steps.displacements["F1"] == pytest.approx(as_told, abs=1e-6)
    assert any("count from there: F1_spoiler_lip" in note for note in steps.data.histories.notes)


def misnamed(case: Path) -> list[str]:
    document = load("case", case).document
    histories = read_case_data(document.histories, case.parent).histories
    return misnamed_records(build_graph(document, histories), histories)


def test_contacts_of_the_shipped_front_are_in_their_paths(case: Path) -> None:
    assert misnamed(case) == []


@pytest.mark.parametrize("record", ["leg", "foam"])
def test_swapped_contacts_are_warned_of_though_every_impulse_closes(case: Path, record: str) -> None:
    text = case.read_text()
    first, second = f'"{record}_F4_*"', f'"{record}_F5_*"'
    case.write_text(text.replace(first, "!").replace(second, first).replace("!", second))
    said = misnamed(case)
    assert len(said) == 2
    assert f"the contact `{record}_F5_bumper_upper` is named after `F5_bumper_upper`" in said[0]


def test_parts_in_the_wrong_groups_are_told_by_their_contacts(case: Path) -> None:
    text = case.read_text()
    case.write_text(text.replace('["F4_*"]', "!").replace('["F6_*"]', '["F4_*"]').replace("!", '["F6_*"]'))
    assert [words for words in misnamed(case) if words.startswith("leg – F4: the contact")]


def test_an_impactor_that_is_not_called_one_is_named(case: Path) -> None:
    assert missing_impactor(steps_of(case)) == []
    case.write_text(case.read_text().replace("kind: impactor", "kind: engine room"))
    assert missing_impactor(steps_of(case))[0].startswith("leg: moves at the start and is no impactor")


def test_a_front_that_nothing_holds_is_refused_for_that(case: Path) -> None:
    text = case.read_text()
    case.write_text("\n".join(row for row in text.splitlines() if ", ground]" not in row) + "\n")
    result = extract(load("case", case).document, case.parent)
    with pytest.raises(DataError, match="add the paths to `ground`"):
        vehicle_text(result)


class Recording(SimpleNamespace):
    def __getitem__(self, name: str) -> SimpleNamespace:
        return SimpleNamespace(values=self.channels[name])


def both(of_run: Callable[[np.ndarray], np.ndarray]) -> tuple[FrontData, Simulation]:
    """Return a run whose T1 is a function of the leg's, and the leg."""
    time = np.arange(0.0, 0.045, 1e-4)
    leg = 200.0 * np.sin(np.pi * time / 0.045) ** 2
    recording = Recording(interval=1e-4, time=time, channels={"T1": leg})
    histories = PartHistories(time=time, parts={}, leg={"T1": of_run(leg)})
    return FrontData(histories, {}), cast("Simulation", SimpleNamespace(recording=recording))


def told(of_run: Callable[[np.ndarray], np.ndarray]) -> list[str]:
    return channel_remarks(*both(of_run), start=0.0, until=0.045)


def test_a_channel_of_the_other_sign_or_in_another_unit_is_told() -> None:
    assert told(lambda x: 1.3 * x) == []
    assert "goes the other way" in told(lambda x: -x)[0]
    assert "is the column in the unit of its name?" in told(lambda x: 1e-3 * x)[0]


def test_a_channel_that_never_rises_above_zero_has_no_peak_to_be_held_to() -> None:
    within = {"start": 0.0, "until": 0.045}
    assert [c.name for c in channel_checks(*both(lambda x: 1.3 * x), **within)] == ["T1"]
    assert channel_checks(*both(lambda x: 1e-9 - x), **within) == ()
