"""What comes with certkit is valid, agrees with itself, and tells where each number comes from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
import yaml

from certkit.definitions.corridor_set import CorridorSet
from certkit.definitions.loading.catalogue import catalogue
from certkit.definitions.loading.kinds import KINDS
from certkit.definitions.loading.library import find, load, names
from certkit.definitions.loading.lint import survey_all
from certkit.definitions.loading.parameter_list import parameters
from certkit.definitions.loading.validation import validate
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.definitions.provenance import CONFIDENCES
from certkit.definitions.units import parse_quantity

if TYPE_CHECKING:
    from pydantic import BaseModel

ENTRIES = [(entry.kind, entry.name) for entry in catalogue()]
PROCEDURES = ["inverse", "inverse-seed", "pendulum", "static-femur", "static-knee", "static-tibia", "vehicle"]
GRADED = ["T1", "T2", "T3", "T4", "MCL", "ACL", "PCL"]
# As read in copies of UN R127, 02 series, annex 6; what the files say has to be these numbers.
READ = {
    "r127-pendulum": {
        "T1": ("235 N·m", "272 N·m"),
        "T2": ("187 N·m", "219 N·m"),
        "T3": ("139 N·m", "166 N·m"),
        "T4": ("90 N·m", "111 N·m"),
        "MCL": ("20.5 mm", "24.0 mm"),
        "ACL": ("8.0 mm", "10.5 mm"),
        "PCL": ("3.5 mm", "5.0 mm"),
    },
    "r127-inverse": {
        "T1": ("230 N·m", "272 N·m"),
        "T2": ("210 N·m", "252 N·m"),
        "T3": ("166 N·m", "192 N·m"),
        "T4": ("93 N·m", "108 N·m"),
        "MCL": ("17.0 mm", "21.0 mm"),
        "ACL": ("8.0 mm", "10.0 mm"),
        "PCL": ("4.0 mm", "6.0 mm"),
    },
}


def test_every_procedure_of_the_contract_is_there():
    assert set(PROCEDURES) <= set(names("procedure"))


def test_everything_shipped_is_valid_and_agrees_with_what_it_names():
    assert [str(problem) for _, found in survey_all() for problem in found] == []


OF_THEIR_OWN = {"bibliography", "budget", "diagnosis", "family", "fit", "scheme", "study"}
"""Kinds whose numbers are no model's: their files say beside them, or once, where they are from."""


@pytest.mark.parametrize(("kind", "name"), ENTRIES)
def test_every_number_has_a_value_a_source_and_a_confidence(kind: str, name: str):
    document = load(kind, name).document
    numbers = parameters(document)
    awaits = isinstance(document, CorridorSet) and document.awaited
    assert numbers or awaits or kind in OF_THEIR_OWN
    for number in numbers:
        assert number.path
        assert number.value
        assert len(number.source) >= 10
        assert number.confidence in CONFIDENCES


def as_data(document: BaseModel) -> object:
    """Return a document as plain data; origins of sections stand beside every number in it anyway."""

    def bare(data: object) -> object:
        if isinstance(data, dict):
            return {key: bare(value) for key, value in data.items() if key != "origin"}
        return [bare(value) for value in data] if isinstance(data, list) else data

    return bare(document.model_dump(mode="json", exclude_none=True))


@pytest.mark.parametrize(("kind", "name"), ENTRIES)
def test_a_document_survives_being_written_and_read_again(kind: str, name: str):
    document = load(kind, name).document
    data = document.model_dump(mode="json", exclude_none=True)
    text = yaml.safe_dump(data, allow_unicode=True, sort_keys=False)
    again = validate(read_tree(text, "again.yaml"), KINDS[kind].model, KINDS[kind].check)
    assert as_data(again) == as_data(document)
    assert parameters(again) == parameters(document)


@pytest.mark.parametrize(("kind", "name"), ENTRIES)
def test_a_file_is_called_what_it_says_it_is(kind: str, name: str):
    assert load(kind, name).name == name


@pytest.mark.parametrize(("kind", "name"), ENTRIES)
def test_a_shipped_file_is_named_without_the_machines_folders(kind: str, name: str):
    assert find(KINDS[kind], name).label == f"{KINDS[kind].folder}/{name}.yaml"


@pytest.mark.parametrize(("kind", "name"), ENTRIES)
def test_no_number_read_nowhere_is_called_verified(kind: str, name: str):
    for number in parameters(load(kind, name).document):
        if "remembered" in number.source and not number.source.startswith("5 kg"):
            assert number.confidence in {"recalled", "estimated"}


@pytest.mark.parametrize("name", READ)
def test_the_dynamic_corridors_are_those_that_were_read_and_name_the_copy(name: str):
    windows = load("corridors", name).document.windows
    assert {entry: (window.lower, window.upper) for entry, window in windows.items()} == READ[name]
    assert {window.confidence for window in windows.values()} == {"verified"}
    assert all("read in a" in window.source for window in windows.values())


@pytest.mark.parametrize(
    ("procedure", "corridors"), [("pendulum", "r127-pendulum"), ("inverse", "r127-inverse")]
)
def test_a_dynamic_test_grades_the_seven_regulated_channels_at_cfc_180(procedure: str, corridors: str):
    criteria = load("procedure", procedure).document.criteria
    assert {c.id: c.corridor for c in criteria if c.corridor} == {i: f"{corridors}/{i}" for i in GRADED}
    assert {c.id for c in criteria if c.corridor is None} == {"F1", "F2", "F3", "LCL"}
    assert {c.filter for c in criteria} == {"CFC 180"}
    assert {c.id for c in criteria if c.measure != "max"} == {"LCL"}


def test_the_seeds_test_grades_nothing_and_is_compared_with_its_table():
    seed = load("procedure", "inverse-seed").document
    assert all(criterion.corridor is None for criterion in seed.criteria)
    assert seed.reference == "seed-table-1"
    assert (seed.rig.ram.mass, seed.rig.ram.speed) == (8.0, 11.0)
    assert seed.rig.ram.mass.confidence == "verified"


def test_the_published_simulation_has_the_errors_that_the_paper_prints():
    table = load("reference", "seed-table-1").document
    errors = {
        name: round(
            100 * (parse_quantity(table.published[name], "moment") / parse_quantity(value, "moment") - 1)
        )
        for name, value in table.values.items()
    }
    assert errors == {"F3": -36, "F2": -13, "F1": 4, "T1": 3, "T2": 0, "T3": -9, "T4": -16}


@pytest.mark.parametrize(("bone", "force"), [("femur", 4606.0), ("tibia", 3707.0)])
def test_the_bones_are_loaded_to_380_newton_metres_which_grades_nothing(bone: str, force: float):
    procedure = load("procedure", f"static-{bone}").document
    assert procedure.rig.loading_ram.force == force
    assert force / 2 * procedure.rig.supports.span / 2 == pytest.approx(380, rel=2e-4)
    assert {c.id: c.corridor for c in procedure.criteria} == {
        "mid-moment": None,
        "moment-deflection": f"r127-static-{bone}/moment-deflection",
    }


def test_the_knee_waits_for_the_regulations_areas():
    criteria = load("procedure", "static-knee").document.criteria
    awaited = load("corridors", "r127-static-knee").document
    assert [c.id for c in criteria] == ["MCL-force", "ACL-force", "PCL-force", "LCL-force"]
    for criterion in criteria[:3]:
        assert awaited.entry(criterion.corridor.partition("/")[2]) is None


def test_the_limits_of_the_vehicle_test_name_the_copy_they_were_read_in():
    windows = load("corridors", "r127-vehicle").document.windows
    limits = {name: window.upper for name, window in windows.items()}
    assert limits == {
        "tibia": "340 N·m",
        "tibia-relaxed": "380 N·m",
        "MCL": "22 mm",
        "ACL": "13 mm",
        "PCL": "13 mm",
    }
    assert all("E/ECE/324/Rev.2/Add.126/Rev.2" in (window.source or "") for window in windows.values())


@pytest.mark.parametrize(("kind", "name"), ENTRIES)
def test_what_was_read_in_an_account_of_a_text_is_not_called_verified(kind: str, name: str):
    for number in parameters(load(kind, name).document):
        if "an account of" in number.source or "CAE Companion" in number.source:
            assert number.confidence == "secondary", number.path


def test_both_bones_have_one_section_and_so_one_stiffness():
    leg = load("legform", "flex-pli-gtr").document
    assert leg.parts["femur"].bending_stiffness == leg.parts["tibia"].bending_stiffness


def test_scores_for_another_legform_are_marked():
    assert load("corridors", "euro-ncap-2026").document.impactor == "aPLI"
    assert load("corridors", "euro-ncap-2014").document.impactor == "Flex-PLI"


def test_masses_of_the_parts_add_up_to_the_legs():
    leg = load("legform", "flex-pli-gtr").document
    bones = leg.parts["femur"].mass + leg.knee.mass + leg.parts["tibia"].mass
    assert bones == pytest.approx(9.38, abs=0.005)
    assert bones + leg.flesh.mass == pytest.approx(13.2, abs=0.005)
    assert leg.parts["femur"].length + leg.knee.above_centre == pytest.approx(0.433)
    assert leg.parts["tibia"].length + leg.knee.below_centre == pytest.approx(0.495)
