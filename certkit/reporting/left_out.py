"""A report that cannot be made on this machine is left out with a remark; the others are written."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

from certkit.errors import LeftOutWarning

if TYPE_CHECKING:
    from certkit.errors import MissingPartError


def leave_out(file: str, error: MissingPartError) -> None:
    """Warn that a file was not written, and why. A command shows it as one line on standard error.

    Python shows a warning of the same words once, so a suite does not repeat it for each procedure.
    """
    warnings.warn(f"{file} is not written: {error}", LeftOutWarning, stacklevel=2)
