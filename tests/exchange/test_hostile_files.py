"""Whatever stands in a container: a recording of finite numbers, or a `DataError`; never anything else."""

from __future__ import annotations

import zipfile
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from support.pendulum_recording import pendulum_like

from certkit.errors import DataError
from certkit.exchange.mme_write import write_mme
from certkit.exchange.read import read_recording

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.exchange.measured import MeasuredData

FEW = 60  # samples; what is hostile stands in heads and archives
HARDLY = settings(
    max_examples=200,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)

spoilings = st.tuples(st.floats(0, 0.99999), st.integers(0, 40), st.binary(max_size=40))


def spoilt(whole: bytes, where: float, cut: int, instead: bytes) -> bytes:
    start = int(where * len(whole))
    return whole[:start] + instead + whole[start + cut :]


def read_or_refused(path: Path, *, lenient: bool) -> MeasuredData | None:
    try:
        return read_recording(path, lenient=lenient)
    except DataError as error:
        assert "\n" not in str(error)  # noqa: PT017  # both outcomes are right
        return None


def assert_sane(read: MeasuredData | None) -> None:
    if read is not None:
        assert np.isfinite(read.recording.time).all()
        assert all(np.isfinite(channel.values).all() for channel in read.recording.channels.values())
        assert all(np.isfinite(value) for value in read.recording.conditions.values())


@pytest.fixture
def small(tmp_path: Path) -> Path:
    write_mme(pendulum_like(FEW, 1e-3), tmp_path / "leg")
    return tmp_path / "leg"


@HARDLY
@given(
    file=st.sampled_from(["leg.mme", "Channel/leg.chn", "Channel/leg.001"]),
    how=spoilings,
    lenient=st.booleans(),
)
def test_a_spoilt_file_of_a_container(
    small: Path, file: str, how: tuple[float, int, bytes], *, lenient: bool
):
    path = small / file
    whole = path.read_bytes()
    path.write_bytes(spoilt(whole, *how))
    try:
        assert_sane(read_or_refused(small, lenient=lenient))
    finally:
        path.write_bytes(whole)


@HARDLY
@given(method=st.sampled_from([zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_LZMA]), how=spoilings)
def test_a_spoilt_archive(small: Path, method: int, how: tuple[float, int, bytes]):
    target = small.with_suffix(".zip")
    with zipfile.ZipFile(target, "w", method) as archive:
        for path in sorted(small.rglob("*.*")):
            archive.write(path, path.relative_to(small))
    target.write_bytes(spoilt(target.read_bytes(), *how))
    assert_sane(read_or_refused(target, lenient=True))


@HARDLY
@given(
    descriptor=st.sampled_from(
        ["Sampling interval", "Time of first sample", "Number of samples", "Unit", "Channel amplitude class"]
    ),
    value=st.one_of(
        st.floats().map(str),
        st.integers().map(str),
        st.sampled_from(["", "NOVALUE", "٣", "1e400", "-0", "0x10", "m²"]),
    ),
)
def test_a_strange_value_in_a_head(small: Path, descriptor: str, value: str):
    path = small / "Channel/leg.001"
    whole = path.read_text(encoding="utf-8")
    lines = [f"{descriptor} :{value}" if line.startswith(descriptor) else line for line in whole.split("\n")]
    path.write_text("\n".join(lines), encoding="utf-8")
    try:
        assert_sane(read_or_refused(small, lenient=True))
    finally:
        path.write_text(whole, encoding="utf-8")
