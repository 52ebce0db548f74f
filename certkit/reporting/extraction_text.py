"""The leg's channels in the self-checks of an extraction, as a table for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.channel_names import channel_words
from certkit.reporting.coupled_check import CONTACT, CONTACT_LEFT_OUT, check_of

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


def check_sentence(check: SelfCheck) -> str:
    """Say what a self-check found, the worst group first."""
    said = [] if check.failed is None else [check.failed]
    if check.worst_percent is not None:
        worst = next(group for group in check.groups if group.rms_percent == check.worst_percent)
        said.append(
            f"{worst.name} moves {1e3 * worst.peak:.0f} mm, in the run {1e3 * worst.run_peak:.0f} mm "
            f"({worst.rms_percent:.0f} % rms); faces in the mean {check.mean_percent:.0f} %"
        )
    elif check.id == CONTACT and check.groups and check.groups[0].force_peak is not None:
        worst = check.groups[0]
        said.append(
            f"{worst.name} is pressed on with {1e-3 * (worst.force_peak or 0.0):.1f} kN, in the run "
            f"{1e-3 * (worst.run_force_peak or 0.0):.1f} kN ({worst.force_rms_percent or 0.0:.0f} % rms)"
        )
    for what, value in (
        ("contact force", check.force_percent),
        ("impulse", check.impulse_percent),
        ("rebound speed", check.rebound_percent),
    ):
        if value is not None:
            said.append(f"{what} {value:+.1f} %")
    if check.wrong_group_percent is not None:
        said.append(f"impulse on another group {check.wrong_group_percent:.1f} %")
    if check.channels:
        channel = check.channels[0]
        said.append(f"worst curve {channel_words(channel.name)}, {channel.rms_percent:.0f} % rms")
        channel = max(check.channels, key=lambda c: abs(c.error_percent))
        said.append(f"worst peak {channel_words(channel.name)}, {channel.error_percent:+.1f} %")
    return f"{check.title}: {'; '.join(said)}"


def left_out(result: ExtractionResult) -> str | None:
    """Say which self-check was left out though a leg was told of, and why."""
    if check_of(result, "coupled") is None or check_of(result, CONTACT) is not None:
        return None
    return CONTACT_LEFT_OUT
