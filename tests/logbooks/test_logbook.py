"""The logbook: counts, due dates, trends, and an index that is nothing but an index."""

from __future__ import annotations

import json
import math
import shutil
import statistics
from datetime import date, timedelta
from itertools import pairwise
from typing import TYPE_CHECKING

import pytest
from support.forty_tests import BEGIN, CERTIFICATIONS, document, forty
from support.writers import booked_by
from typer.testing import CliRunner

from certkit.cli.commands import whole_app
from certkit.definitions.logbook_rules import LogbookRules
from certkit.documents.output_document import listed_json
from certkit.documents.result import InputFile, Provenance
from certkit.errors import DataError, UsageError
from certkit.logbooks import Logbook, add, rebuild, shipped_rules
from certkit.logbooks import overview as drawn_up
from certkit.reporting.language import worded
from certkit.reporting.logbook_page import logbook_page

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from certkit.documents.logbook_overview import LegOverview, Validity
    from certkit.documents.result import Result


def overview(
    book: Logbook, serial: str, rules: LogbookRules | None = None, day: date | None = None
) -> LegOverview:
    """Return the overview with its reasons worded, as the commands show it."""
    return worded(drawn_up(book, serial, rules=rules, day=day))


def kept(folder: Path, results: list[Result]) -> Logbook:
    paths = []
    for place, result in enumerate(results):
        paths.append(folder / "in" / f"{place}.json")
        result.write(paths[-1])
    logbook = Logbook(folder / "book")
    add(logbook, paths)
    return logbook


@pytest.fixture(scope="module")
def booked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Forty tests and their logbook, booked once: to bring each to the disk takes longer than all else."""
    folder = tmp_path_factory.mktemp("booked")
    kept(folder, forty())
    return folder


@pytest.fixture
def logbook(booked: Path, tmp_path: Path) -> Logbook:
    shutil.copytree(booked, tmp_path, dirs_exist_ok=True)
    return Logbook(tmp_path / "book")


def test_forty_tests_of_two_legforms_are_counted(logbook: Logbook):
    assert logbook.serials() == ["A-1", "B-2"]
    for serial in logbook.serials():
        leg = overview(logbook, serial)
        assert len(leg.tests) == 20
        assert leg.counts == {
            "inverse": 1,
            "pendulum": 7,
            "static-femur": 1,
            "static-knee": 1,
            "static-tibia": 1,
            "vehicle": 9,
        }


def test_due_dates_follow_the_last_certification(logbook: Logbook):
    leg = overview(logbook, "A-1")
    due = {line.title: line.due for line in leg.validity if line.rule == "interval"}
    assert set(due.values()) == {(BEGIN + timedelta(days=365)).isoformat()}
    on_the_day = overview(logbook, "A-1", day=BEGIN + timedelta(days=365))
    assert on_the_day.state == "valid"
    assert overview(logbook, "A-1", day=BEGIN + timedelta(days=366)).state == "due"


def vehicle_tests(first: int, count: int, t1: float = 300.0) -> list[Result]:
    days = range(first, first + count)
    return [document("C", BEGIN + timedelta(days=n), n, "vehicle", t1, upper=340.0) for n in days]


def sequence(folder: Path, results: list[Result]) -> Validity:
    return next(line for line in overview(kept(folder, results), "C").validity if line.rule == "sequence")


def test_inverse_pendulum_pendulum_follow_in_turn_with_ten_vehicle_tests_between(tmp_path: Path):
    results = [document("C", BEGIN, 1, "inverse", 250.0), *vehicle_tests(2, 10)]
    line = sequence(tmp_path / "1", results)
    assert (line.used, line.left, line.state) == (10, 0, "due")
    assert line.why.endswith("pendulum is next")
    results += [document("C", BEGIN + timedelta(days=12), 12, "pendulum", 250.0), *vehicle_tests(13, 3)]
    line = sequence(tmp_path / "2", results)
    assert (line.used, line.left, line.state) == (3, 7, "valid")
    results += [document("C", BEGIN + timedelta(days=20), 20, "pendulum", 250.0)]
    assert sequence(tmp_path / "3", results).why.endswith("inverse is next")


def test_a_pendulum_where_the_inverse_test_is_next_does_not_count(tmp_path: Path):
    names = ("inverse", "pendulum", "pendulum")
    results = [document("C", BEGIN, n, name, 250.0) for n, name in enumerate(names, 1)]
    results += [*vehicle_tests(4, 6), document("C", BEGIN + timedelta(days=10), 10, "pendulum", 250.0)]
    assert sequence(tmp_path, results).used == 6


def test_a_failed_certification_or_an_eleventh_vehicle_test_breaks_the_series(tmp_path: Path):
    begin = [document("C", BEGIN, 1, "inverse", 250.0)]
    failed = [*begin, document("C", BEGIN + timedelta(days=2), 2, "pendulum", 200.0)]
    line = sequence(tmp_path / "failed", failed)
    assert (line.state, line.why) == ("revoked", "pendulum ended in `fail` on 2025-01-08, after 2025-01-06")
    late = [*begin, *vehicle_tests(2, 11), document("C", BEGIN + timedelta(days=13), 13, "pendulum", 250.0)]
    assert sequence(tmp_path / "late", late).state == "due"
    again = [*late, document("C", BEGIN + timedelta(days=14), 14, "inverse", 250.0)]
    assert sequence(tmp_path / "again", again).left == 10


def test_euro_ncap_counts_impacts_from_the_last_passed_certification(tmp_path: Path):
    rules = shipped_rules("euro-ncap-v7")
    results = [document("C", BEGIN, n, name, 250.0) for n, name in ((1, "pendulum"), (2, "inverse"))]
    results += vehicle_tests(3, 12)
    leg = overview(kept(tmp_path, results), "C", rules=rules)
    impacts = next(line for line in leg.validity if line.rule == "count")
    assert (impacts.used, impacts.left, impacts.state) == (12, 0, "due")


def test_rules_that_are_not_shipped_are_refused_with_those_that_are():
    with pytest.raises(UsageError, match="one of euro-ncap-v7, r127"):
        shipped_rules("jncap")


def test_tests_of_one_day_follow_each_other_by_number(tmp_path: Path):
    results = [
        document("C", BEGIN, 10, "inverse", 250.0),
        document("C", BEGIN, 9, "vehicle", 300.0, upper=340.0),
    ]
    leg = overview(kept(tmp_path, results), "C")
    assert [line.number for line in leg.tests] == ["2025-9", "2025-10"]
    assert next(line for line in leg.validity if line.rule == "sequence").used == 0


def test_a_reading_beyond_its_amplitude_class_ends_the_certification(tmp_path: Path):
    rules = shipped_rules("euro-ncap-v7")
    results = [document("C", BEGIN, n, name, 250.0) for n, name in ((1, "pendulum"), (2, "inverse"))]
    within = overview(kept(tmp_path, [*results, *vehicle_tests(3, 1, 399.0)]), "C", rules=rules)
    assert within.validity[-1].state == "valid"
    over = overview(kept(tmp_path / "over", [*results, *vehicle_tests(3, 1, 404.0)]), "C", rules=rules)
    assert over.validity[-1].state == "due"
    assert "T1 read 404 N·m on 2025-01-09 (vehicle), 1% over 400" in over.validity[-1].why


def test_a_leg_that_never_passed_was_never_certified(tmp_path: Path):
    leg = overview(kept(tmp_path, vehicle_tests(1, 1)), "C")
    assert leg.state == "never certified"
    assert "inverse never passed" in leg.validity[0].why


def test_scatter_is_that_of_the_values(logbook: Logbook):
    trend = next(t for t in overview(logbook, "B-2").trends if t.procedure == "pendulum")
    values = [250.0] + [250.0 + (0.1 if n % 2 else -0.1) for n in range(1, 7)]
    assert trend.values == pytest.approx(values)
    assert trend.mean == pytest.approx(statistics.fmean(values))
    assert trend.variation_percent == pytest.approx(100 * statistics.stdev(values) / statistics.fmean(values))
    assert trend.leaves is None
    assert trend.remark == "no drift"


def test_a_drift_is_followed_to_the_edge_of_the_corridor(tmp_path: Path):
    # 250 N·m and 1 N·m more every 30 days reaches 272 N·m after 660 days.
    results = [document("C", BEGIN + timedelta(days=30 * n), n, "pendulum", 250.0 + n) for n in range(6)]
    trend = overview(kept(tmp_path, results), "C").trends[0]
    assert trend.drifts
    assert trend.slope_per_year == pytest.approx(365.25 / 30)
    assert trend.leaves is not None
    assert abs((date.fromisoformat(trend.leaves) - BEGIN).days - 660) <= 1


def test_a_jump_is_outside_the_control_limits(tmp_path: Path):
    values = [250.0, 250.5, 249.8, 250.2, 249.9, 250.1, 249.7, 250.3, 258.0]
    results = [document("C", BEGIN + timedelta(days=n), n, "pendulum", v) for n, v in enumerate(values)]
    assert overview(kept(tmp_path, results), "C").trends[0].outside_control == [9]


def test_control_limits_are_three_deviations_by_the_mean_moving_range(tmp_path: Path):
    values = [250.0, 251.5, 249.8, 250.2, 252.9, 250.1]
    results = [document("C", BEGIN + timedelta(days=n), n, "pendulum", v) for n, v in enumerate(values)]
    trend = overview(kept(tmp_path, results), "C").trends[0]
    moving = statistics.fmean(abs(b - a) for a, b in pairwise(values))
    # ISO 7870-2: the mean range of two is 1.128 deviations.
    assert trend.control_upper - trend.mean == pytest.approx(3 / 1.128 * moving, rel=1e-3)
    assert trend.mean - trend.control_lower == pytest.approx(3 / 1.128 * moving, rel=1e-3)


@pytest.mark.parametrize(("errors", "drifts"), [(1.9, [False]), (2.1, [True])])
def test_a_slope_is_a_drift_from_two_standard_errors_on(tmp_path: Path, errors: float, drifts: list[bool]):
    # What is left beside a line through eight days is ±1 and has no slope: the error is √(8/6/42).
    beside = (1, -1, -1, 1, 1, -1, -1, 1)
    values = [250.0 + errors * math.sqrt(8 / 6 / 42) * n + off for n, off in enumerate(beside)]
    results = [document("C", BEGIN + timedelta(days=n), n, "pendulum", v) for n, v in enumerate(values)]
    assert [trend.drifts for trend in overview(kept(tmp_path, results), "C").trends] == drifts


def test_vehicle_tests_have_no_trend(logbook: Logbook):
    assert "vehicle" not in {trend.procedure for trend in overview(logbook, "A-1").trends}


def test_the_page_is_the_same_after_the_index_was_deleted_and_made_again(logbook: Logbook):
    before = logbook_page([overview(logbook, serial) for serial in logbook.serials()])
    logbook.index.unlink()
    assert rebuild(logbook) == 40
    assert logbook_page([overview(logbook, serial) for serial in logbook.serials()]) == before


def test_the_page_replaces_no_other_file_unless_it_is_told_to(logbook: Logbook, tmp_path: Path):
    page = tmp_path / "page.html"
    page.write_text("mine", "utf-8")
    words = ["history", "show", "A-1", "--logbook", str(logbook.folder), "--html", str(page)]
    refused = CliRunner().invoke(whole_app(), words)
    assert isinstance(refused.exception, UsageError)
    assert page.read_text("utf-8") == "mine"
    assert CliRunner().invoke(whole_app(), [*words, "--force"]).exit_code in {0, 1}
    assert "A-1" in page.read_text("utf-8")


@pytest.mark.parametrize(
    "damage",
    [
        lambda index: index.unlink(),
        lambda index: index.write_bytes(b""),
        lambda index: index.write_bytes(b"SQLite format 3\x00"),
        lambda index: index.write_bytes(index.read_bytes()[:-300]),
        lambda index: index.write_bytes(index.read_bytes().replace(b'"verdict":"pass"', b'"verdict":"fail"')),
        lambda index: index.write_bytes(index.read_bytes().replace(b"250.0", b"251.0")),
        lambda index: index.write_bytes(b"[" * 100_000),
        lambda index: next((index.parent / "results").glob("*pendulum*")).touch(),
    ],
    ids=["missing", "empty", "another format", "cut", "verdicts edited", "values edited", "deep", "older"],
)
def test_an_index_that_does_not_agree_with_the_documents_mends_itself(
    logbook: Logbook, damage: Callable[[Path], object]
):
    before, index = listed_json([overview(logbook, "A-1")]), logbook.index.read_bytes()
    damage(logbook.index)
    assert listed_json([overview(logbook, "A-1")]) == before
    if logbook.index.stat().st_size:
        assert json.loads(logbook.index.read_text())["files"].keys() == json.loads(index)["files"].keys()


def test_a_document_put_or_taken_by_hand_is_noticed(logbook: Logbook):
    taken = next(path for path in logbook.documents.iterdir() if "static-knee" in path.name)
    taken.unlink()
    document("C-3", date(2025, 6, 1), 1, "pendulum", 251.0).write(logbook.documents / "by-hand.json")
    assert logbook.serials() == ["A-1", "B-2", "C-3"]
    assert sum(overview(logbook, serial).counts.get("static-knee", 0) for serial in ("A-1", "B-2")) == 1


def test_eight_writers_lose_nothing(tmp_path: Path):
    assert booked_by(8, 3, tmp_path) == (24, 24, 24, 24)


def test_one_recording_graded_twice_is_one_test(tmp_path: Path):
    data = [InputFile(role="recording", path="leg.csv", sha256="ab" * 32)]
    first, again = (
        document("A-1", BEGIN, 1, "pendulum", value)
        .model_copy(update={"provenance": Provenance(certkit=version, inputs=data, packages={}), "id": ""})
        .with_id()
        for value, version in ((280.0, "1"), (250.0, "2"))
    )
    logbook = kept(tmp_path, [first])
    again.write(tmp_path / "again.json")
    with pytest.raises(DataError, match=rf"in the logbook already, as {first.id}.*fail"):
        add(logbook, [tmp_path / "again.json"])
    assert [entry.verdict for entry in logbook.entries("A-1")] == ["fail"]


def test_one_serial_number_written_in_two_ways_is_one_legform_unless_the_rules_say_otherwise(tmp_path: Path):
    logbook = kept(
        tmp_path,
        [
            document("FLX-0007", BEGIN, 1, "pendulum", 250.0),
            document("flx-0007", BEGIN + timedelta(days=1), 2, "inverse", 250.0),
        ],
    )
    assert logbook.serials() == ["FLX-0007"]
    assert overview(logbook, "Flx-0007").counts == {"inverse": 1, "pendulum": 1}
    assert logbook.serials(exact=True) == ["FLX-0007", "flx-0007"]
    exact = shipped_rules().model_copy(update={"serial_numbers": "exact"})
    assert overview(logbook, "flx-0007", rules=exact).counts == {"inverse": 1}


@pytest.mark.parametrize("kind", ["virtual certification", "virtual test"])
def test_what_was_not_measured_is_never_booked_for_a_legform(tmp_path: Path, kind: str):
    result = document("A-1", BEGIN, 1, "pendulum", 250.0).model_copy(update={"kind": kind, "id": ""})
    with pytest.raises(DataError, match=f"is a {kind}; measured tests only"):
        kept(tmp_path, [result.with_id()])
    assert not list((tmp_path / "book").rglob("*.json"))


@pytest.mark.parametrize("procedure", ["pendulum", "static-knee"])
@pytest.mark.parametrize("verdict", ["fail", "conditional", "error"])
def test_a_later_test_that_does_not_pass_takes_the_certification_back(
    tmp_path: Path, verdict: str, procedure: str
):
    tests = [document("A-1", BEGIN, n, name, 250.0) for n, name in enumerate(CERTIFICATIONS)]
    later = document("A-1", BEGIN + timedelta(days=3), 9, procedure, 250.0)
    later = later.model_copy(update={"verdict": verdict, "id": ""}).with_id()
    assert overview(kept(tmp_path / "before", tests), "A-1").state == "valid"
    leg = overview(kept(tmp_path / "after", [*tests, later]), "A-1")
    assert leg.state == "revoked"
    assert any(f"ended in `{verdict}`" in line.why for line in leg.validity)
    mended = document("A-1", BEGIN + timedelta(days=4), 10, procedure, 250.0)
    assert overview(kept(tmp_path / "mended", [*tests, later, mended]), "A-1").state == "valid"


def test_the_same_test_is_kept_once(logbook: Logbook, tmp_path: Path):
    new, known = add(logbook, [tmp_path / "in" / "3.json"])
    assert (len(new), len(known)) == (0, 1)
    assert len(overview(logbook, "A-1").tests) == 20


def test_a_changed_document_is_refused_and_nothing_is_kept(logbook: Logbook, tmp_path: Path):
    good, changed = tmp_path / "good.json", tmp_path / "changed.json"
    document("A-1", date(2025, 6, 1), 99, "pendulum", 251.0).write(good)
    changed.write_text((tmp_path / "in" / "3.json").read_text().replace('"value":250.0', '"value":251.0'))
    with pytest.raises(DataError, match="was changed"):
        add(logbook, [good, changed])
    assert len(overview(logbook, "A-1").tests) == 20


def test_a_document_without_a_laboratory_is_refused(tmp_path: Path):
    result = document("A", BEGIN, 1, "pendulum", 250.0)
    path = tmp_path / "result.json"
    bare = result.model_copy(update={"laboratory": None, "id": ""})

    bare.with_id().write(path)
    with pytest.raises(DataError, match="no serial number"):
        add(Logbook(tmp_path / "book"), [path])
    assert not (tmp_path / "book").exists()


def test_a_serial_cannot_lead_out_of_the_logbook(tmp_path: Path):
    logbook = kept(tmp_path, [document("../../etc/x'; DROP TABLE tests;--", BEGIN, 1, "pendulum", 250.0)])
    files = [path.name for path in (logbook.folder / "results").iterdir()]
    assert len(files) == 1
    assert "/" not in files[0]
    assert overview(logbook, logbook.serials()[0]).counts == {"pendulum": 1}


def test_an_unknown_serial_names_those_there_are(logbook: Logbook):
    with pytest.raises(UsageError, match="it has A-1, B-2"):
        overview(logbook, "Z")


def test_a_laboratory_has_its_own_rules(logbook: Logbook):
    rules = LogbookRules.model_validate(
        {
            "logbook": "ours",
            "title": "ours",
            "rules": [
                {
                    "rule": "interval",
                    "title": "monthly",
                    "certified by": ["pendulum"],
                    "every": "30 d",
                    "source": "our quality manual",
                    "confidence": "verified",
                }
            ],
        }
    )
    leg = overview(logbook, "A-1", rules=rules)
    assert [line.title for line in leg.validity] == ["monthly"]
    assert json.loads(listed_json([leg]))[0]["validity"][0]["due"] == "2025-05-21"
