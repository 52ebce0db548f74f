"""Results that every report test looks at."""

from __future__ import annotations

import pytest
from support import synthetic_result

from certkit.documents.result import Result


@pytest.fixture(scope="session")
def pendulum() -> Result:
    """Return a simulated pendulum test that passes."""
    return synthetic_result.result()


@pytest.fixture(scope="session")
def bending() -> Result:
    """Return a static test with curves in a plane."""
    return synthetic_result.static_result()


@pytest.fixture(scope="session")
def measured() -> Result:
    """Return a measured test that fails, with a laboratory's header."""
    return synthetic_result.laboratory_result()
