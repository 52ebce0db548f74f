"""One blow is one test: the same samples under another number, day, legform or laboratory are told."""

from __future__ import annotations

from pathlib import Path

import pytest

import certkit
from certkit.bench.round_robin import round_robin
from certkit.documents.result import Result
from certkit.errors import DataError, TakenAsSaidWarning
from certkit.logbooks import Logbook, add
from certkit.logbooks.same_blow import shared_channels

MEASURED = Path(__file__).parents[2] / "examples" / "measured"


@pytest.fixture(scope="module")
def graded() -> Result:
    return certkit.grade("pendulum", MEASURED / "FLX-0007-pendulum.zip", laboratory=MEASURED / "lab.yaml")


def _booked(result: Result, folder: Path, **header: dict[str, str]) -> Path:
    """Write a result whose laboratory says other things of the same test."""
    laboratory = dict(result.laboratory or {})
    for key, told in header.items():
        laboratory[key] = {**laboratory[key], **told}
    path = folder / f"{len(list(folder.iterdir()))}.json"
    path.write_text(result.model_copy(update={"laboratory": laboratory}).with_id().to_json())
    return path


@pytest.mark.parametrize(
    "header",
    [
        {"test": {"number": "2026-015"}},
        {"test": {"number": "2026-015", "performed": "2026-03-03"}},
        {"item": {"serial": "FLX-0008"}, "test": {"number": "2026-015"}},
    ],
    ids=["number", "day", "legform"],
)
def test_a_logbook_tells_of_samples_that_come_twice(
    graded: Result, header: dict[str, dict[str, str]], tmp_path: Path
):
    first, second = _booked(graded, tmp_path), _booked(graded, tmp_path, **header)
    book = Logbook(tmp_path / "logbook")
    add(book, [first])
    told = r"sample by sample those of .*FLX-0007, pendulum, 2026-03-02"
    with pytest.warns(TakenAsSaidWarning, match=told):
        new, _ = add(book, [second])
    assert len(new) == 1
    with pytest.warns(TakenAsSaidWarning, match="sample by sample"):
        add(Logbook(tmp_path / "other"), [first, second])


def test_a_round_robin_takes_no_samples_twice(graded: Result, tmp_path: Path):
    places = [_booked(graded, tmp_path), _booked(graded, tmp_path, test={"number": "7"})]
    with pytest.raises(DataError, match=r"1\.json: ACL, .* are sample by sample those of .*0\.json"):
        round_robin(places)


def test_a_revision_of_a_report_keeps_its_samples(graded: Result, tmp_path: Path):
    first = _booked(graded, tmp_path)
    again = {"revision": 1, "replaces": graded.id, "number": "2026-014a"}
    book = Logbook(tmp_path / "logbook")
    add(book, [first])
    add(book, [_booked(graded, tmp_path, test=again)])
    assert len(book.entries("FLX-0007")) == 2


def test_one_ramp_in_common_makes_no_two_tests_one():
    assert shared_channels(["load:aa", "T1:bb", "MCL:cc"], ["load:aa", "T1:bc", "MCL:cd"]) == ""
    assert shared_channels(["load:aa", "T1:bb", "MCL:cc"], ["load:aa", "T1:bb", "MCL:cd"]) == "T1, load"


def test_a_made_up_value_is_booked_and_certified_by_nobody(graded: Result, tmp_path: Path):
    """Its id is made anew; only grading again shows it."""
    criteria = [
        each.model_copy(update={"value": 250.0}) if each.id == "T1" else each for each in graded.criteria
    ]
    forged = graded.model_copy(update={"criteria": criteria}).with_id()
    path = tmp_path / "forged.json"
    path.write_text(forged.to_json())
    with pytest.raises(DataError, match=r"forged\.json: comes to other values when it is graded again"):
        certkit.logbook(tmp_path / "logbook", tests=path)
    assert not (tmp_path / "logbook").exists()
    add(Logbook(tmp_path / "logbook"), [path])  # as whoever writes into the folder itself would
    with pytest.raises(DataError, match=f"{forged.id}: comes to other values"):
        certkit.certify("FLX-0007", folder=tmp_path / "logbook")


def test_a_test_of_an_earlier_version_is_booked_with_a_remark_and_certified_by_nobody(
    graded: Result, tmp_path: Path
):
    """Its definitions have a word that is not known any more, so nobody can grade it again."""
    inputs = [
        item.model_copy(update={"text": item.text.replace("knee centre below", "below knee centre")})
        if item.role == "procedure" and item.text
        else item
        for item in graded.provenance.inputs
    ]
    provenance = graded.provenance.model_copy(update={"inputs": inputs})
    path = tmp_path / "old.json"
    path.write_text(graded.model_copy(update={"provenance": provenance}).with_id().to_json())
    with pytest.warns(TakenAsSaidWarning, match=r"cannot be graded again by this certkit \(.*it is booked"):
        (leg,) = certkit.logbook(tmp_path / "logbook", tests=path)
    assert len(leg.tests) == 1
    with pytest.raises(DataError, match="cannot be graded again"):
        certkit.certify("FLX-0007", folder=tmp_path / "logbook")
