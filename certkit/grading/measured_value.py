"""What was measured: one number and when it occurred, or why there is none."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

if TYPE_CHECKING:
    from certkit.definitions.channels import Dimension
    from certkit.grading.trace import Trace
    from certkit.reasons import Reason


class MeasuredValue(Struct, frozen=True):
    """What was measured.

    Parameters
    ----------
    value, time : float or None
        SI value and the time it occurred at, s; None when it could not be measured.
    dimension : Dimension or None
        Of the value; None when not even the channel is known.
    reason : Reason or None
        Why there is no value.
    trace : Trace or None
        The samples, for measures that hold a whole curve against a corridor.
    doubt : Reason or None
        Why the value is no evidence though it could be read, from `certkit.grading.plausibility_gate`.
    """

    value: float | None
    time: float | None
    dimension: Dimension | None
    reason: Reason | None = None
    trace: Trace | None = None
    doubt: Reason | None = None
