"""All readers give the same part histories, with the traps of each format handled."""

from __future__ import annotations

import importlib.util
import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from certkit.definitions.loading.library import load
from certkit.errors import DataError
from certkit.exchange.fe import parse_units, read_case_data
from certkit.exchange.fe.radioss import impulse_of_differences, part_histories
from certkit.exchange.fe.readers.openradioss_csv import read_converted
from certkit.exchange.fe.readers.openradioss_native import read_native

if TYPE_CHECKING:
    from certkit.exchange.fe import PartHistories

CASES = Path(__file__).parents[3] / "examples/extract"
BUMPER = CASES / "bumper-reference"
HAS_LASSO = importlib.util.find_spec("lasso") is not None


def histories(case: str) -> PartHistories:
    document = load("case", BUMPER / case).document
    return read_case_data(document.histories, BUMPER).histories


@pytest.fixture(scope="module")
def native() -> PartHistories:
    return histories("case.yaml")


@pytest.mark.parametrize("part", ["impactor", "fascia", "back_beam"])
@pytest.mark.parametrize("case", ["case-converted.yaml", "case-tidy.yaml"])
def test_every_format_tells_the_same_momentum(native: PartHistories, case: str, part: str) -> None:
    other = histories(case)
    assert np.allclose(other.time, native.time, atol=1e-8)
    wanted = native.part(part).momentum
    assert wanted is not None
    assert np.abs(other.part(part).momentum - wanted).max() < 1e-6 * np.abs(wanted).max()


@pytest.mark.parametrize("contact", ["impactor-fascia", "fascia-foam", "foam-beam"])
@pytest.mark.parametrize("case", ["case-converted.yaml", "case-tidy.yaml"])
def test_every_format_tells_the_same_contact_impulse_but_for_its_sign(
    native: PartHistories, case: str, contact: str
) -> None:
    wanted = np.abs(native.contact(contact).impulse)
    assert np.abs(np.abs(histories(case).contact(contact).impulse) - wanted).max() < 1e-6 * wanted.max()


def test_a_rigid_body_has_the_momentum_of_its_main_node(native: PartHistories) -> None:
    impactor = native.part("impactor")
    assert impactor.mass == 6.0
    assert impactor.momentum is not None
    assert impactor.momentum[0] == pytest.approx(6.0 * 11.1, rel=1e-6)


def test_a_crushed_foam_keeps_its_initial_mass(native: PartHistories) -> None:
    assert native.part("foam").mass == pytest.approx(0.096, rel=1e-6)
    assert any("drifts" in note for note in native.notes)


def test_an_undescribed_rigid_body_has_no_momentum() -> None:
    channels = read_native(BUMPER / "time-history.T01.gz")
    parts = part_histories(channels, parse_units("kg mm ms"), {}).parts
    assert parts["impactor"].momentum is None


def test_contact_channels_are_impulses_in_the_native_file_and_differences_in_the_converted_one() -> None:
    channels = read_native(BUMPER / "time-history.T01.gz")
    impulse = channels.contacts["fascia-foam"]["FNX"]
    force = read_converted(BUMPER / "time-history.csv.gz").contacts["fascia-foam"]["FNX"]
    assert np.abs(force).max() < 0.2 * np.abs(impulse).max()
    assert np.abs(impulse_of_differences(force, channels.time) - impulse).max() < 1e-5 * np.abs(impulse).max()


def test_jittered_times_are_kept_as_they_are(native: PartHistories) -> None:
    steps = np.diff(native.time)
    assert steps.max() / steps.min() > 1.02


def test_units_are_converted_whatever_the_model_was_built_in() -> None:
    units = parse_units("t mm s")
    assert units.force == pytest.approx(1.0)
    assert units.momentum == pytest.approx(1.0)
    assert parse_units("kg mm ms").force == pytest.approx(1e3)


def test_unknown_units_are_refused() -> None:
    with pytest.raises(DataError, match="`lb in s` are not known"):
        parse_units("lb in s")


def test_a_front_in_the_same_layout_is_read_by_patterns() -> None:
    document = load("case", CASES / "front1/case.yaml").document
    data = read_case_data(document.histories, CASES / "front1")
    assert data.histories.part("F4_*").front is not None
    assert data.histories.part("E4_*").front is None
    face = data.faces["F1_spoiler_lip"]
    assert face.slope is not None
    assert face.slope < 0  # the spoiler's lip leans forward towards its upper edge


@pytest.mark.skipif(not HAS_LASSO, reason="lasso-python is not installed")
def test_a_binout_tells_the_same_as_the_native_file(native: PartHistories) -> None:
    other = histories("case-binout.yaml")
    wanted = native.part("fascia").momentum
    assert wanted is not None
    assert np.abs(other.part("fascia").momentum - wanted).max() < 1e-3 * np.abs(wanted).max()
    assert other.part("impactor").momentum[0] == pytest.approx(66.6, rel=1e-4)


@pytest.mark.skipif(not HAS_LASSO, reason="lasso-python is not installed")
def test_a_pattern_names_all_binouts_of_a_run() -> None:
    section = load("case", BUMPER / "case-binout.yaml").document.histories
    several = section.model_copy(update={"files": ["bumper.binout*"]})
    data = read_case_data(several, BUMPER).histories
    assert list(data.files) == ["bumper.binout0000"]
    with pytest.raises(DataError, match="no file fits"):
        read_case_data(section.model_copy(update={"files": ["other*"]}), BUMPER)


@pytest.mark.skipif(HAS_LASSO, reason="lasso-python is installed")
def test_without_lasso_python_a_binout_says_how_to_install_it() -> None:
    with pytest.raises(DataError, match=r"pip install 'certkit\[binout\]'"):
        histories("case-binout.yaml")


@pytest.mark.skipif(
    not HAS_LASSO or "CERTKIT_LS_DYNA_FILES" not in os.environ,
    reason="needs lasso-python and genuine LS-DYNA files in $CERTKIT_LS_DYNA_FILES",
)
def test_genuine_binouts_without_part_sums_are_refused_by_name() -> None:
    from certkit.exchange.fe.readers.ls_dyna_binout import read_binout  # noqa: PLC0415  # optional

    folder = Path(os.environ["CERTKIT_LS_DYNA_FILES"])
    for path in sorted(p for p in folder.rglob("binout*") if p.is_file()):
        with pytest.raises(DataError, match="no matsum"):
            read_binout(path, parse_units("kg mm ms"), {})


@pytest.mark.skipif(
    not HAS_LASSO or "CERTKIT_LS_DYNA_FILES" not in os.environ,
    reason="needs lasso-python and genuine LS-DYNA files in $CERTKIT_LS_DYNA_FILES",
)
def test_every_table_of_genuine_binouts_can_be_read() -> None:
    from certkit.exchange.fe.binout_files import BinoutFiles  # noqa: PLC0415  # optional
    from certkit.exchange.fe.binout_tables import BinoutTables  # noqa: PLC0415  # likewise

    folder = Path(os.environ["CERTKIT_LS_DYNA_FILES"])
    for path in sorted(p for p in folder.rglob("binout*") if p.is_file()):
        files = BinoutFiles([path])
        tables = BinoutTables(files, path.name)
        assert tables.tables()
        for table in tables.tables():
            assert tables.times(table, 1e-3).size > 10
            assert len(tables.legend(table)) == len(tables.ids(table))
        files.close()
