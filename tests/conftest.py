"""The real command as people run it, and a made-up pendulum recording as laboratories write it."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Generator
from pathlib import Path

import pytest
from support.command import Command
from support.curves import write_csv
from support.missing_parts import PANGO, excuse, pango_is_missing, skipped
from support.pendulum_recording import pendulum_like

from certkit.exchange.mme_write import write_mme
from certkit.signals import Recording


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Skip what needs a PDF where none can be set."""
    if item.get_closest_marker("pdf") and pango_is_missing():
        pytest.skip(PANGO)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Skip what turned out to need a PDF, in a test or in a fixture."""
    report = yield
    if report.failed and call.excinfo is not None and (reason := excuse(call.excinfo.value)):
        skipped(report, item, reason)
    return report


@pytest.fixture
def certkit(tmp_path: Path) -> Command:
    """Run `certkit …` in an empty folder; keyword arguments are added to the environment."""

    def call(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-m", "certkit", *arguments],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
            env={**os.environ, "NO_COLOR": "1", **environment},
        )

    return call


@pytest.fixture
def recording() -> Recording:
    """Return a pendulum test that passes."""
    return pendulum_like()


@pytest.fixture
def mme(tmp_path: Path, recording: Recording) -> Path:
    """Write the recording as an ISO-MME folder that a test may damage."""
    folder = tmp_path / "leg"
    write_mme(recording, folder)
    return folder


@pytest.fixture
def table(tmp_path: Path, recording: Recording) -> Path:
    """Write the recording as CSV."""
    path = tmp_path / "leg.csv"
    write_csv(recording, path)
    return path
