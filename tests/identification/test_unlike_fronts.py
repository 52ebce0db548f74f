"""Fronts unlike the shipped one: groups that nothing touches, several contacts a path, things forgotten."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from certkit.definitions.loading.library import load
from certkit.errors import DataError
from certkit.identification.five_steps import extract
from certkit.identification.vehicle_file import vehicle_text
from tests.support.changed_fronts import FRONT, HISTORIES, change, copied

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.documents.extraction import ExtractionResult
    from tests.support.changed_fronts import Rows


def extracted(case: Path, folder: Path = FRONT) -> ExtractionResult:
    return extract(load("case", case).document, folder)


@pytest.fixture
def case(tmp_path: Path) -> Path:
    path = tmp_path / "case.yaml"
    path.write_text((FRONT / "case.yaml").read_text())
    return path


def without(case: Path, word: str) -> None:
    lines = case.read_text().splitlines()
    case.write_text("\n".join(line for line in lines if word not in line))


def test_a_group_that_nothing_pushes_is_left_out_of_the_vehicle_and_named(tmp_path: Path) -> None:
    """A hood that the leg does not reach: nothing is known of how it would give way."""
    case = copied(tmp_path)
    case.write_text(
        case.read_text().replace(
            "paths:",
            '  E8: {kind: engine room, parts: ["E8_*"]}\n  H8: {kind: hood, parts: ["H8_*"]}\n'
            "paths:\n  - {between: [E8, ground]}\n  - {between: [H8, E8], tension: true}",
            1,
        )
    )
    idle = {
        f"{part}__{what}": "0" for part in ("E8_mount", "H8_lid") for what in ("px_Ns", "cgx_mm", "frontx_mm")
    }
    change(tmp_path / "vehicle_groups.csv", lambda rows: [{**row, **idle} for row in rows], also=[*idle])
    rows: Rows = [
        {"group": "E8_mount", "mass_kg": "1"},
        {
            "group": "H8_lid",
            "mass_kg": "1",
            "z_low_mm": "900",
            "z_high_mm": "950",
            "x_front_min_mm": "700",
            "x_front_max_mm": "710",
        },
    ]
    change(tmp_path / "groups_table.csv", lambda own: [*own, *rows])
    result = extracted(case, tmp_path)
    assert any(w.startswith("H8: nothing that carries a force leads") for w in result.warnings)
    vehicle = tmp_path / "vehicle.yaml"
    vehicle.write_text(vehicle_text(result))
    groups = load("vehicle", vehicle).document.groups
    assert "F1" in groups
    assert not {"E8", "H8"} & set(groups)


def test_a_path_may_have_several_contacts_whose_impulses_add_up(case: Path) -> None:
    without(case, '{kind: fascia, parts: ["F6_*"]}')
    text = case.read_text()
    for line in ('[leg, F6], contact: "leg_F6_*"', '[F6, E2], contact: "foam_F6_*"', "[F6, F7], tension"):
        text = "\n".join(row for row in text.splitlines() if line not in row)
    for old, new in (
        ('F7: {kind: fascia, parts: ["F7_*"]}', 'F7: {kind: fascia, parts: ["F6_*", "F7_*"]}'),
        ('"leg_F7_*"', '["leg_F6_*", "leg_F7_*"]'),
        ('"foam_F7_*"', '["foam_F6_*", "foam_F7_*"]'),
        ("[F5, F6]", "[F5, F7]"),
    ):
        text = text.replace(old, new)
    case.write_text(text)
    apart = {p.name: np.array(p.impulse) for p in extracted(FRONT / "case.yaml").paths}
    result = extracted(case)
    paths = {p.name: np.array(p.impulse) for p in result.paths}
    assert paths["leg – F7"] == pytest.approx(apart["leg – F6"] + apart["leg – F7"])
    assert max(c.percent for path in result.paths for c in path.closures) < 0.5


def test_where_impulse_does_not_close_the_record_that_no_path_names_is_pointed_at(case: Path) -> None:
    without(case, "E5")
    warned = extracted(case).warnings
    assert any("impulse does not close: all impulse into and out of H1, H2" in w for w in warned)
    assert any(w.startswith("recorded, but in no path: spring E5_latch_support") for w in warned)


def test_a_face_in_no_group_is_warned_of_however_light_it_is(case: Path) -> None:
    text = "\n".join(r for r in case.read_text().splitlines() if "F6" not in r)
    case.write_text(
        text.replace(
            "  - {between: [F7, E4]", "  - {between: [F5, F7], tension: true}\n  - {between: [F7, E4]"
        )
    )
    warned = [w for w in extracted(case).warnings if "`F6_upper_grille` is in no group" in w]
    assert len(warned) == 1
    assert "the leg meets nothing at its face" in warned[0]


def test_a_run_towards_minus_x_is_refused_with_what_to_turn(tmp_path: Path) -> None:
    case = copied(tmp_path)
    along = ("px_Ns", "Jx_Ns", "Fx_N", "cgx_mm", "frontx_mm")

    def turned(rows: Rows) -> Rows:
        turn = {c for c in rows[0] if c.endswith(along) or c.startswith("gx_")}
        return [{c: f"{-float(v):.9g}" if c in turn else v for c, v in row.items()} for row in rows]

    for name in HISTORIES:
        change(tmp_path / f"{name}.csv", turned)
    with pytest.raises(DataError, match="the impactor `leg` moves towards -x"):
        extracted(case, tmp_path)


def test_a_fascia_that_is_pushed_along_by_what_it_slides_on_has_a_path_though_it_never_comes_nearer(
    tmp_path: Path,
) -> None:
    case = copied(tmp_path)
    face, behind = "F2_lower_grille__frontx_mm", "E1_lower_stiffener__cgx_mm"
    change(
        tmp_path / "vehicle_groups.csv",
        lambda rows: [{**row, face: f"{0.9 * float(row[behind]):.9g}"} for row in rows],
    )
    path = next(p for p in extracted(case, tmp_path).paths if p.name == "F2 – E1")
    assert max(path.shortening) < 1e-6
    assert path.sheet is not None
    assert max(path.sheet.force) > 1000.0
