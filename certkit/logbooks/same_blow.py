"""Whether two tests rest on one blow: the same samples, whatever files, numbers and names they came under."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Result

MOST = 0.5
"""Share of the channels that two tests have in common which has to be the same, for them to be one blow. A
made-up ramp may be that of two static tests; half of a leg's sensors never show the same samples twice."""


def channel_digests(result: Result) -> tuple[str, ...]:
    """Return `T1:` with a digest of its samples for each channel that moves; empty without channels.

    Where the record begins, and what a channel's name is in words, is no part of it.
    """
    found = []
    for name, series in sorted((result.channels.series if result.channels is not None else {}).items()):
        values = np.array(series.values, dtype=np.float64)
        if values.size > 1 and float(np.ptp(values)) > 0.0:
            found.append(f"{name}:{hashlib.sha256(values.tobytes()).hexdigest()[:16]}")
    return tuple(found)


def shared_channels(one: Sequence[str], other: Sequence[str]) -> str:
    """Return the names of the channels that two tests share, where those say that they are one blow; else "".

    Parameters
    ----------
    one, other : sequence of str
        From `channel_digests`.
    """
    mine, theirs = (dict(each.rsplit(":", 1) for each in digests) for digests in (one, other))
    common = mine.keys() & theirs.keys()
    same = sorted(name for name in common if mine[name] == theirs[name])
    if not same or len(same) <= MOST * len(common):
        return ""
    return ", ".join(same[:3]) + (f" and {len(same) - 3} more" if len(same) > 3 else "")
