"""Every number of a document is listed with its words and its origin."""

from __future__ import annotations

import pickle

import pytest

from certkit.definitions.fixtures.hinge import Hinge
from certkit.definitions.fixtures.ram import Ram
from certkit.definitions.loading.library import load
from certkit.definitions.loading.parameter_list import ListedParameter, parameters
from certkit.definitions.provenance import Number, Origin


def test_a_number_is_an_ordinary_float_with_words():
    number = Number(0.025, "25 mm", "my drawing", "verified")
    assert number * 2 == 0.05
    again = pickle.loads(pickle.dumps(number))  # noqa: S301  # our own bytes
    assert (again, again.text, again.source, again.confidence) == (0.025, "25 mm", "my drawing", "verified")


def test_a_number_takes_its_sections_origin_unless_it_has_its_own():
    hinge = Hinge.model_validate(
        {"at": "tibia end", "origin": {"source": "my drawing", "confidence": "verified"}, "offset": "25 mm"}
    )
    assert (hinge.offset.source, hinge.offset.confidence) == ("my drawing", "verified")
    own = {"value": "25 mm", "source": "a guess", "confidence": "estimated"}
    hinge = Hinge.model_validate({"at": "tibia end", "origin": hinge.origin, "offset": own})
    assert (hinge.offset.source, hinge.offset.confidence) == ("a guess", "estimated")


def test_part_of_an_origin_may_be_inherited():
    origin = Origin(source="my drawing", confidence="verified")
    hinge = Hinge.model_validate(
        {"at": "tibia end", "origin": origin, "offset": {"value": "25 mm", "confidence": "estimated"}}
    )
    assert (hinge.offset.source, hinge.offset.confidence) == ("my drawing", "estimated")


def test_a_number_without_any_origin_is_refused():
    with pytest.raises(ValueError, match="has no origin"):
        Hinge.model_validate({"at": "tibia end", "offset": "25 mm"})


def test_fields_can_be_given_by_their_python_names():
    origin = Origin(source="my drawing", confidence="verified")
    ram = Ram.model_validate(
        {
            "origin": origin,
            "mass": "8 kg",
            "speed": "11 m/s",
            "crush_strength": "75 psi",
            "height": "160 mm",
            "depth": "60 mm",
            "top_edge": "0 mm",
            "width_on_knee": "100 mm",
            "width_on_bones": "40 mm",
        }
    )
    assert ram.crush_strength == pytest.approx(517_107, rel=1e-5)


def test_a_procedures_numbers_are_listed_in_the_files_order():
    listed = parameters(load("procedure", "pendulum").document)
    assert [number.path for number in listed[:3]] == [
        "rig.hinge.offset",
        "rig.added mass.offset",
        "rig.added mass.mass",
    ]
    assert "preconditions.temperature" in {number.path for number in listed}


def test_a_corridor_is_one_line():
    (first, *_) = parameters(load("corridors", "r127-pendulum").document)
    assert first == ListedParameter(
        "windows.T1",
        "235 N·m to 272 N·m",
        "UN R127, 02 series, annex 6, 1.3; read in a public text extraction of "
        "E/ECE/324/Rev.2/Add.126/Rev.2, which has no figures",
        "verified",
    )


def test_points_of_a_ligament_are_listed_one_by_one():
    paths = {number.path for number in parameters(load("legform", "flex-pli-gtr").document)}
    assert {"knee.ligaments.MCL.femur.x", "knee.ligaments.MCL.femur.z"} <= paths
    assert "channels.T4.from knee centre" in paths
