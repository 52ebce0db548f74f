"""The leg's channels in the self-checks of an extraction, as a table for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.channel_names import channel_words

if TYPE_CHECKING:
    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.self_check import SelfCheck

HEADS = ("channel, CFC 180", "in the run", "model", "error", "later by", "curve, rms of peak")


def channels_table(result: ExtractionResult) -> str:
    """Return peaks, their times and the curves of both checks that have a leg; empty where none has.

    The leg alone shows what of the coupled run's errors is the leg's own.
    """
    return "\n\n".join(_table(check) for check in result.checks if check.channels)


def _table(check: SelfCheck) -> str:
    rows = [HEADS]
    for channel in sorted(check.channels, key=lambda c: c.name):
        scale, unit = (1e3, "mm") if channel.name.endswith("CL") else (1.0, "N·m")
        rows.append(
            (
                channel_words(channel.name),
                f"{scale * channel.run_peak:.1f} {unit} at {1e3 * channel.run_time:.1f} ms",
                f"{scale * channel.peak:.1f} {unit} at {1e3 * channel.time:.1f} ms",
                f"{channel.error_percent:+.1f} %",
                f"{1e3 * (channel.time - channel.run_time):+.1f} ms",
                f"{channel.rms_percent:.1f} %",
            )
        )
    widths = [max(len(row[k]) for row in rows) for k in range(len(HEADS))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in rows]
    until = f"{check.title}, up to {1e3 * check.until:.0f} ms of the run"
    return "\n".join([until, *(line.rstrip() for line in lines)])
