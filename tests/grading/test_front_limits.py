"""A front against the room behind its groups and the curves of its springs."""

from __future__ import annotations

import pytest

from certkit.definitions.loading.overrides import Overrides
from certkit.definitions.vehicle import Vehicle
from certkit.documents.result import Front
from certkit.grading.front_limits import beyond_range, front_use

FRONT = {
    "vehicle": "made up",
    "title": "One face before one beam",
    "origin": {"source": "made up", "confidence": "estimated"},
    "groups": {
        "face": {"kind": "fascia", "mass": "0.3 kg", "low": "400 mm", "high": "500 mm", "position": "0 mm"},
        "beam": {"kind": "engine room", "mass": "4 kg"},
    },
    "springs": {
        "foam": {"between": ["face", "beam"], "loading": [["0 mm", "0 N"], ["60 mm", "4000 N"]]},
        "boxes": {"between": ["beam", "ground"], "loading": [["0 mm", "0 N"], ["10 mm", "9000 N"]]},
    },
}


def made(groups: dict[str, Overrides] | None = None, springs: dict[str, Overrides] | None = None) -> Vehicle:
    def merged(key: str, changes: dict[str, Overrides] | None) -> dict[str, object]:
        found: dict[str, dict[str, object]] = FRONT[key]
        return {name: {**part, **(changes or {}).get(name, {})} for name, part in found.items()}

    return Vehicle.model_validate(
        {**FRONT, "groups": merged("groups", groups), "springs": merged("springs", springs)}
    )


def run(face: float = 50.0, beam: float = 5.0) -> Front:
    """Return a front whose face and beam went so far, mm."""
    histories = {"start": 0.0, "interval": 1e-3, "count": 2}
    moved = {"face": face, "beam": beam}
    curves = {"foam": face - beam, "boxes": beam}
    return Front.model_validate(
        {
            "contact": {**histories, "series": {}},
            "displacement": {
                **histories,
                "series": {n: {"title": n, "unit": "mm", "values": [0.0, x]} for n, x in moved.items()},
            },
            "springs": {
                name: {
                    "x_title": "shortening",
                    "x_unit": "mm",
                    "y_title": "force",
                    "y_unit": "N",
                    "points": [[0.0, 0.0], [x, 1.0]],
                }
                for name, x in curves.items()
            },
            "received": {},
            "absorbed": {},
        }
    )


def test_a_group_with_room_is_held_against_it_and_the_others_against_what_a_car_has():
    use = front_use(run(face=50.0, beam=5.0), made(groups={"beam": {"room": "20 mm"}}))
    assert use.travel_mm == 50.0
    assert use.room is not None
    assert (use.room.name, use.room.percent) == ("beam", pytest.approx(25.0))


def test_the_group_that_uses_most_of_its_room_is_named():
    rooms = {"beam": {"room": "4 mm"}, "face": {"room": "100 mm"}}
    use = front_use(run(face=50.0, beam=5.0), made(groups=rooms))
    assert use.room is not None
    assert (use.room.name, use.room.percent) == ("beam", pytest.approx(125.0))
    assert use.travel_mm == 0.0


def test_an_extracted_spring_is_held_against_the_end_of_its_curve():
    use = front_use(run(face=70.0, beam=5.0), made(springs={"foam": {"seen": "40 mm"}}))
    assert use.springs is not None
    assert (use.springs.name, use.springs.percent) == ("foam", pytest.approx(100 * 65 / 60))


def test_a_spring_that_nobody_extracted_is_only_remarked_upon():
    use = front_use(run(face=70.0), made())
    assert use.springs is None
    assert [reason.parameters["spring"] for reason in beyond_range(run(face=70.0), made())] == ["foam"]
    assert beyond_range(run(face=60.0), made()) == []


def test_an_extracted_spring_is_remarked_upon_beyond_what_was_seen_of_it():
    seen = made(springs={"foam": {"seen": "40 mm"}})
    assert [reason.parameters["last"] for reason in beyond_range(run(face=50.0, beam=5.0), seen)] == [40.0]
    assert beyond_range(run(face=45.0, beam=5.0), seen) == []


def test_a_sheet_is_remarked_upon_beyond_its_path():
    path = [["0 mm", "0 mm", "0 N"], ["30 mm", "20 mm", "500 N"]]
    sheet = {"between": ["face", "beam"], "path": path, "stiffness": "10 N/mm", "damping": "10 N·s/m"}
    made_of = Vehicle.model_validate({**FRONT, "sheets": {"skin": sheet}})
    said = beyond_range(run(face=58.0, beam=6.0), made_of)
    assert [(r.code, r.parameters["progress"], r.parameters["last"]) for r in said] == [
        ("sheet-beyond-path", 32.0, 30.0)
    ]
    assert beyond_range(run(face=54.0, beam=6.0), made_of) == []


def test_room_is_a_length_above_zero():
    with pytest.raises(ValueError, match="no room, no travel"):
        made(groups={"beam": {"room": "0 mm"}})
