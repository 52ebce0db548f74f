"""An extraction's load paths and the leg's channels in its self-checks, as tables for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.channel_names import channel_scale, channel_words
from certkit.reporting.coupled_check import CONTACT, CONTACT_LEFT_OUT, check_of
from certkit.reporting.number_format import MISSING, fixed, signed
from certkit.reporting.plaintext import aligned

if TYPE_CHECKING:
    from certkit.documents.extraction import EnergyResult, ExtractionResult
    from certkit.documents.self_check import SelfCheck

HEADS = ("channel, CFC 180", "in the run", "model", "error", "later by", "curve, rms of peak")


PATH_HEADS = (
    "path",
    "peak force",
    "impulse",
    "closure",
    "law misfit",
    "absorbed (law)",
    "returned (law)",
    "known by",
)


def paths_table(result: ExtractionResult) -> str:
    """Return one line a load path."""
    rows = [
        (
            path.name,
            f"{fixed(path.peak_force, 0)} N",
            f"{fixed(max(path.impulse, key=abs), 2)} N·s",
            f"{max(c.percent for c in path.closures):.2f} %" if path.closures else MISSING,
            f"{path.law.misfit_percent:.1f} %" if path.law else MISSING,
            _energies(path.energy, "absorbed"),
            _energies(path.energy, "returned"),
            path.known_by,
        )
        for path in result.paths
    ]
    return aligned(PATH_HEADS, rows, right=range(1, len(PATH_HEADS) - 1))


def _energies(energy: EnergyResult | None, which: str) -> str:
    """Say an energy of the run's path, and of its law."""
    if energy is None:
        return MISSING
    law = getattr(energy, f"law_{which}")
    return f"{fixed(getattr(energy, which), 1)} J" + ("" if law is None else f" ({fixed(law, 1)} J)")


def channels_table(result: ExtractionResult) -> str:
    """Return peaks, their times and the curves of both checks that have a leg; empty where none has.

    The leg alone shows what of the coupled run's errors is the leg's own.
    """
    return "\n\n".join(_table(check) for check in result.checks if check.channels)


def _table(check: SelfCheck) -> str:
    rows = []
    for channel in sorted(check.channels, key=lambda c: c.name):
        scale, unit = channel_scale(channel.name)
        rows.append(
            (
                channel_words(channel.name),
                f"{fixed(scale * channel.run_peak, 1)} {unit} at {1e3 * channel.run_time:.1f} ms",
                f"{fixed(scale * channel.peak, 1)} {unit} at {1e3 * channel.time:.1f} ms",
                f"{signed(channel.error_percent, 1)} %",
                f"{signed(1e3 * (channel.time - channel.run_time), 1)} ms",
                f"{channel.rms_percent:.1f} %",
            )
        )
    until = f"{check.title}, up to {1e3 * check.until:.0f} ms of the run"
    return f"{until}\n{aligned(HEADS, rows, right=(1, 2, 3, 4, 5))}"


def check_sentence(check: SelfCheck) -> str:
    """Say what a self-check found, the worst group first."""
    said = [] if check.failed is None else [check.failed]
    if check.worst_percent is not None:
        worst = next(group for group in check.groups if group.rms_percent == check.worst_percent)
        said.append(
            f"{worst.name} moves {fixed(1e3 * worst.peak, 0)} mm, "
            f"in the run {fixed(1e3 * worst.run_peak, 0)} mm "
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
            said.append(f"{what} {signed(value, 1)} %")
    if check.wrong_group_percent is not None:
        said.append(f"impulse on another group {check.wrong_group_percent:.1f} %")
    if check.channels:
        channel = check.channels[0]
        said.append(f"worst curve {channel_words(channel.name)}, {channel.rms_percent:.0f} % rms")
        channel = max(check.channels, key=lambda c: abs(c.error_percent))
        said.append(f"worst peak {channel_words(channel.name)}, {signed(channel.error_percent, 1)} %")
    return f"{check.title}: {'; '.join(said)}"


def left_out(result: ExtractionResult) -> str | None:
    """Say which self-check was left out though a leg was told of, and why."""
    if check_of(result, "coupled") is None or check_of(result, CONTACT) is not None:
        return None
    return CONTACT_LEFT_OUT
