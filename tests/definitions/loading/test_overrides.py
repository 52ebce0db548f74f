"""`--set path=value` changes one value for one run, and the document says so."""

from __future__ import annotations

import pytest

from certkit.definitions.loading.library import load
from certkit.definitions.loading.overrides import Change, overrides_from
from certkit.errors import DefinitionError, OldFormWarning, UsageError


def test_a_changed_number_says_that_it_was_set_on_the_command_line():
    loaded = load("procedure", "pendulum", overrides={"rig.added mass.mass": "5100 g"})
    mass = loaded.document.rig.added_mass.mass
    assert mass == pytest.approx(5.1)
    assert (mass.source, mass.confidence) == ("set on the command line", "estimated")
    assert loaded.overrides == (Change("rig.added mass.mass", "5100 g", "5 kg"),)


def test_the_file_itself_stays_what_it_was():
    changed = load("procedure", "pendulum", overrides={"rig.added mass.mass": "6 kg"})
    plain = load("procedure", "pendulum")
    assert changed.sha256 == plain.sha256
    assert changed.text == plain.text
    assert plain.document.rig.added_mass.mass == 5.0


@pytest.mark.parametrize(
    "path", ["rig.added mass.mass", "rig.added_mass.mass", "rig.added-mass.mass", "Rig.Added Mass.Mass"]
)
def test_spaces_may_be_written_as_underscores_or_hyphens(path: str):
    loaded = load("procedure", "pendulum", overrides=overrides_from([f"{path} = 6 kg"]))
    assert loaded.document.rig.added_mass.mass == 6.0
    assert loaded.overrides[0].path == "rig.added mass.mass"


def test_a_criterion_is_named_by_its_id_and_its_number_is_an_old_name():
    by_id = load("procedure", "pendulum", overrides={"criteria.T2.filter": "none"})
    with pytest.warns(OldFormWarning, match=r"write `criteria\.T2\.filter`"):
        by_number = load("procedure", "pendulum", overrides={"criteria.2.filter": "none"})
    assert by_id.document == by_number.document
    assert by_id.document.criteria[1].filter == "none"
    assert by_id.overrides[0].was == "CFC 180"


def test_a_key_that_the_file_does_not_have_can_be_set():
    loaded = load("procedure", "pendulum", overrides={"run.time step": "1e-5 s", "reference": "seed-table-1"})
    assert loaded.document.run.time_step == pytest.approx(1e-5)
    assert loaded.document.reference == "seed-table-1"
    assert [change.was for change in loaded.overrides] == [None, None]


def test_a_fixture_can_be_taken_away_and_another_one_put_on():
    bare = load("procedure", "pendulum", overrides={"rig.stopper": "null"})
    assert bare.document.rig.stopper is None
    swapped = load(
        "procedure", "pendulum", overrides={"rig.added mass": "{at: tibia end, offset: 1 mm, mass: 1 kg}"}
    )
    assert swapped.document.rig.added_mass.mass.confidence == "estimated"


def test_later_changes_win():
    loaded = load(
        "procedure",
        "pendulum",
        overrides=overrides_from(["rig.hinge.offset=30 mm", "rig.hinge.offset=31 mm"]),
    )
    assert loaded.document.rig.hinge.offset == pytest.approx(0.031)


def test_a_legforms_number_and_a_ligaments_point_can_be_changed():
    overrides = {"parts.femur.bending stiffness": "190 N·m²", "knee.ligaments.MCL.femur": ["40 mm", "20 mm"]}
    leg = load("legform", "flex-pli-gtr", overrides=overrides).document
    assert leg.parts["femur"].bending_stiffness == 190.0
    assert leg.knee.ligaments["MCL"].femur == [pytest.approx(0.040), pytest.approx(0.020)]
    assert {number.source for number in leg.knee.ligaments["MCL"].femur} == {"set on the command line"}


def test_a_changed_corridor_is_no_longer_the_regulations():
    loaded = load("corridors", "r127-pendulum", overrides={"windows.T1.upper": "280 N·m"})
    window = loaded.document.windows["T1"]
    assert (window.upper, window.source, window.confidence) == (
        "280 N·m",
        "set on the command line",
        "estimated",
    )
    assert loaded.document.windows["T2"].confidence == "verified"


@pytest.mark.parametrize(
    ("override", "said"),
    [
        ("rig.hing.ofset=30 mm", "there is no such value; did you mean `rig.hinge.offset`"),
        ("criteria.T9.filter=none", "did you mean `criteria.T"),
        ("zzz=1", "known: criteria, method"),
        ("rig.hinge.offset.value.deeper=1 mm", "there is no such value"),
        ("rig.hinge.offset", "write PATH=VALUE"),
        ("=3", "write PATH=VALUE"),
    ],
)
def test_a_path_that_leads_nowhere_brings_the_nearest_one(override: str, said: str):
    with pytest.raises(UsageError, match=said):
        load("procedure", "pendulum", overrides=overrides_from([override]))


@pytest.mark.parametrize(
    ("override", "said"),
    [
        ("rig.hinge.offset=30", "--set rig.hinge.offset: `30` has no unit"),
        ("rig.hinge.at=tibia", "--set rig.hinge.at: `tibia` is no end of the leg; did you mean `tibia end`"),
        ("rig.hinge.at=[", "--set rig.hinge.at: is not YAML"),
        (
            "criteria.T1.channel=tibia moment 9",
            "--set criteria.T1.channel: no channel is called `tibia moment 9`",
        ),
        ("rig.hinge.offset=&a [*a]", "names no value before it"),
    ],
)
def test_a_value_that_does_not_fit_is_reported_at_the_option(override: str, said: str):
    with pytest.raises(DefinitionError) as caught:
        load("procedure", "pendulum", overrides=overrides_from([override]))
    assert said in str(caught.value)
