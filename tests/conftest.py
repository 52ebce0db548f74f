"""The real command as people run it, and a made-up pendulum recording as laboratories write it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from support.command import Command
from support.pendulum_recording import pendulum_like

from certkit.exchange.channels_csv import write_csv
from certkit.exchange.mme_write import write_mme
from certkit.signals import Recording


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
