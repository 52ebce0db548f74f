"""One certificate for one legform: the tests that it rests on, what it refuses to mix, what is missing."""

from __future__ import annotations

from datetime import timedelta
from pathlib import Path

import pytest
from support.forty_tests import BEGIN, CERTIFICATIONS, document

from certkit.bench.certify import certify
from certkit.documents.result import Result
from certkit.errors import DataError, UsageError
from certkit.logbooks import Issue, Logbook, add, certificate_of, overview


def booked(folder: Path, results: list[Result]) -> Path:
    paths = []
    for place, result in enumerate(results):
        paths.append(folder / "in" / f"{place}.json")
        result.write(paths[-1])
    add(Logbook(folder / "book"), paths)
    return folder / "book"


def five(serial: str = "A-1") -> list[Result]:
    return [document(serial, BEGIN, number, name, 250.0) for number, name in enumerate(CERTIFICATIONS, 1)]


def changed(result: Result, **test: str | int) -> Result:
    laboratory = result.laboratory or {}
    told = {**laboratory, "test": {**laboratory["test"], **test}}
    return result.model_copy(update={"laboratory": told, "id": ""}).with_id()


def reasons(folder: Path, serial: str = "A-1") -> set[str]:
    return {reason.code for reason in certify(serial, folder=folder).coded_remarks}


def test_five_passed_tests_of_one_legform_pass(tmp_path: Path):
    made = certify("A-1", folder=booked(tmp_path, five()))
    assert made.verdict == "pass"
    assert [test.id for test in made.tests] == [result.id for result in made.results]
    assert {test.procedure for test in made.tests} == set(CERTIFICATIONS)
    assert made.next_due == (BEGIN + timedelta(days=365)).isoformat()
    assert made.content_id() == made.id


def test_a_missing_test_is_named_and_nothing_passes_without_it(tmp_path: Path):
    made = certify("A-1", folder=booked(tmp_path, five()[:-1]))
    assert made.verdict == "not evaluated"
    missing = next(test for test in made.tests if not test.id)
    assert missing.procedure == "static-knee"
    assert any("static-knee is missing" in remark for remark in made.remarks)


def test_the_last_test_of_each_procedure_decides(tmp_path: Path):
    failed = document("A-1", BEGIN + timedelta(days=3), 9, "pendulum", 200.0)
    book = booked(tmp_path, [*five(), failed])
    assert certify("A-1", folder=book).verdict == "fail"
    before = certify("A-1", folder=book, day=BEGIN + timedelta(days=2))
    assert before.verdict == "pass"  # on that day it had not been done
    mended = document("A-1", BEGIN + timedelta(days=4), 10, "pendulum", 250.0)
    assert certify("A-1", folder=booked(tmp_path / "2", [*five(), failed, mended])).verdict == "pass"


def test_a_certification_that_has_run_out_does_not_pass(tmp_path: Path):
    book = booked(tmp_path, five())
    late = certify("A-1", folder=book, day=BEGIN + timedelta(days=366))
    assert late.verdict == "not evaluated"
    assert "certificate-overdue" in {reason.code for reason in late.coded_remarks}


def test_rules_say_which_tests_are_asked_for(tmp_path: Path):
    book = booked(tmp_path, five()[:2])
    assert certify("A-1", folder=book).verdict == "not evaluated"
    assert certify("A-1", folder=book, rules="euro-ncap-v7").verdict == "pass"


def test_serial_numbers_are_not_mixed(tmp_path: Path):
    leg = overview(Logbook(booked(tmp_path, five())), "A-1")
    swapped = [*five()[:-1], document("B-2", BEGIN, 5, "static-knee", 250.0)]
    with pytest.raises(DataError, match=r"static-knee .* is a test of the legform B-2"):
        certificate_of(leg, swapped, Issue())


def test_a_simulated_test_certifies_no_legform(tmp_path: Path):
    leg = overview(Logbook(booked(tmp_path, five())), "A-1")
    simulated = five()[0].model_copy(update={"kind": "virtual certification", "id": ""}).with_id()
    with pytest.raises(DataError, match="is a virtual certification, not a measured test"):
        certificate_of(leg, [simulated, *five()[1:]], Issue())


def test_tests_that_are_handed_over_are_all_looked_at_before_any_is_booked(tmp_path: Path):
    simulated = five()[1].model_copy(update={"kind": "virtual certification", "id": ""}).with_id()
    given = [five()[0], simulated, document("B-2", BEGIN, 5, "static-knee", 250.0)]
    paths = []
    for place, result in enumerate(given):
        paths.append(tmp_path / f"{place}.json")
        result.write(paths[-1])
    with pytest.raises(DataError) as caught:
        certify("A-1", paths, folder=tmp_path / "book")
    assert "1.json: is a virtual certification" in str(caught.value)
    assert "2.json: is a test of the legform B-2, not of A-1" in str(caught.value)
    assert not (tmp_path / "book").exists()


def test_a_legform_that_nobody_knows_is_refused(tmp_path: Path):
    with pytest.raises(UsageError, match="knows no legform `C-3`"):
        certify("C-3", folder=booked(tmp_path, five()))


@pytest.mark.parametrize("by", ["id", "number"])
def test_a_replaced_report_does_not_count_and_is_not_taken(tmp_path: Path, by: str):
    first = five()
    named = first[0].id if by == "id" else "2025-1"
    amended = changed(first[0], revision=1, replaces=named, reason="a slip", changes="a word")
    book = Logbook(booked(tmp_path, [*first, amended]))
    leg = overview(book, "A-1")
    lines = {line.id: line for line in leg.tests}
    assert lines[first[0].id].replaced_by == amended.id
    assert leg.counts["pendulum"] == 1
    made = certify("A-1", folder=book.folder)
    pendulum = next(test for test in made.tests if test.procedure == "pendulum")
    assert (pendulum.id, pendulum.revision, pendulum.replaces) == (amended.id, 1, named)
    with pytest.raises(DataError, match=f"was replaced by the report {amended.id}"):
        certificate_of(leg, first, Issue())


def test_another_laboratorys_report_of_that_number_is_not_replaced(tmp_path: Path):
    first = five()
    amended = changed(first[0], revision=1, replaces="2025-1", reason="a slip", changes="a word")
    elsewhere = amended.model_copy(
        update={"laboratory": {**(amended.laboratory or {}), "laboratory": "Another"}, "id": ""}
    ).with_id()
    leg = overview(Logbook(booked(tmp_path, [*first, elsewhere])), "A-1")
    assert all(line.replaced_by is None for line in leg.tests)


def test_an_earlier_test_of_a_procedure_is_not_taken_in_place_of_the_last(tmp_path: Path):
    later = document("A-1", BEGIN + timedelta(days=3), 9, "pendulum", 251.0)
    leg = overview(Logbook(booked(tmp_path, [*five(), later])), "A-1")
    with pytest.raises(DataError, match="is not the last test of its procedure"):
        certificate_of(leg, five(), Issue())


def test_what_stands_against_a_certificate_is_said_test_by_test(tmp_path: Path):
    ungraded = five()[2]
    criteria = [c.model_copy(update={"graded": False, "verdict": "not evaluated"}) for c in ungraded.criteria]
    ungraded = ungraded.model_copy(
        update={"criteria": type(ungraded.criteria)(criteria), "verdict": "not evaluated", "id": ""}
    ).with_id()
    made = certify("A-1", folder=booked(tmp_path, [*five()[:2], ungraded, *five()[3:]]))
    assert made.verdict == "not evaluated"
    assert "static-femur is not evaluated: no limits are known to grade it by." in made.remarks
