"""Write a recording as an ISO-MME (ISO/TS 13499, edition 1.6) folder or zip: same recording, same bytes."""

from __future__ import annotations

import io
import zipfile
from typing import TYPE_CHECKING

from certkit.definitions.units import UNITS, from_si
from certkit.errors import UsageError
from certkit.exchange.codes import CodeTable, code_table
from certkit.exchange.mme_header import NOVALUE, OWN_SIMULATION
from certkit.files import write_whole
from certkit.files.folder_switch import FolderSwitch

if TYPE_CHECKING:
    from collections.abc import Mapping as Lookup
    from pathlib import Path

    from certkit.definitions.channel_mapping import Mapping
    from certkit.signals.recording import Channel, Recording

_UNIT = {"N·m": "Nm", "m/s²": "m/(s*s)"}
_SI_UNIT = {"temperature": "K", "ratio": ""}
_EPOCH = (1980, 1, 1, 0, 0, 0)


def write_mme(
    recording: Recording,
    target: Path,
    *,
    test: str | None = None,
    header: Lookup[str, str] | None = None,
    mapping: Mapping | None = None,
) -> None:
    """Write a container.

    Parameters
    ----------
    recording : Recording
        What is written: every channel that has a code.
    target : Path
        A new folder, or a file that ends in `.zip`.
    test : str, optional
        Name of the test, for the file names; the target's name unless given.
    header : mapping of str to str, optional
        Descriptors of the `.mme` file, such as `Laboratory name`.
    mapping : Mapping, optional
        A laboratory's own codes.

    Raises
    ------
    UsageError
        When the target folder exists, or no channel has a code.
    """
    if target.suffix.lower() == ".zip":
        write_whole(target, mme_archive(recording, test or target.stem, header, mapping), durable=True)
        return
    files = mme_files(recording, test or target.stem, header or {}, code_table(mapping, recording.table))
    if target.exists():
        raise UsageError(f"{target} exists; name a new folder, or a .zip file")
    with FolderSwitch(target) as switch:
        for path, text in files.items():
            write_whole(switch.stage / path, text)


def mme_archive(
    recording: Recording,
    test: str,
    header: Lookup[str, str] | None = None,
    mapping: Mapping | None = None,
) -> bytes:
    """Return a container as a zip archive; see `write_mme`. The same recording gives the same bytes."""
    return _zipped(mme_files(recording, test, header or {}, code_table(mapping, recording.table)))


def mme_files(recording: Recording, name: str, header: Lookup[str, str], table: CodeTable) -> dict[str, str]:
    """Return the container's files by path; see `write_mme`."""
    channels = [channel for key, channel in recording.channels.items() if key in table.codes]
    if not channels:
        raise UsageError("no channel of the recording has an ISO-MME code; a mapping file can name them")
    codes = [table.code(channel.name, channel.filtered) for channel in channels]
    listed = [
        _line(f"Name of channel {number:03d}", f"{code} / {channel.title}")
        for number, (code, channel) in enumerate(zip(codes, channels, strict=True), 1)
    ]
    files = {
        f"{name}.mme": _master(recording, header, table),
        f"Channel/{name}.chn": "".join(
            [
                _line("Instrumentation standard", "ISO 6487"),
                _line("Number of channels", str(len(channels))),
                *listed,
            ]
        ),
    }
    for number, (code, channel) in enumerate(zip(codes, channels, strict=True), 1):
        files[f"Channel/{name}.{number:03d}"] = _channel(recording, channel, code)
    return files


def _line(descriptor: str, value: str) -> str:
    # A line break in a value would start a new descriptor.
    return f"{descriptor:<29}:{' '.join(value.split()) or NOVALUE}\n"


def _master(recording: Recording, header: Lookup[str, str], table: CodeTable) -> str:
    given = dict(header)
    lines = [_line("Data format edition number", "1.6")]
    lines += [
        _line(descriptor, given.pop(descriptor, NOVALUE))
        for descriptor in (
            "Laboratory name",
            "Customer name",
            "Title",
            "Timestamp",
            "Type of the test",
            "Regulation",
        )
    ]
    comments = []
    for word, value in sorted(recording.conditions.items()):
        known = table.conditions.get(word)
        if known is not None and known.descriptor is not None:
            given.setdefault(known.descriptor, f"{from_si(value, known.dimension, known.unit):.9g}")
        elif known is not None:
            unit = _SI_UNIT.get(known.dimension) or next(
                u for u, scale in UNITS[known.dimension].items() if scale == 1.0
            )
            comments.append(_line("Comments", f"{word} = {value:.9g} {unit}"))
    lines += [_line(descriptor, value) for descriptor, value in given.items()]
    own = [_line("Comments", OWN_SIMULATION)] if recording.kind == "simulated" else []
    lines += [_line("Number of test objects", "1"), *own, *comments]
    return "".join(lines)


def _channel(recording: Recording, channel: Channel, code: str) -> str:
    unit = channel.dimension.unit
    head = [
        _line("Test object number", "1"),
        _line("Name of the channel", channel.title),
        _line("Laboratory channel code", NOVALUE),
        _line("Customer channel code", NOVALUE),
        _line("Channel code", code),
        _line("Comments", "; ".join(map(str, channel.notes))),
        _line("Location", NOVALUE),
        _line("Dimension", channel.dimension.name.capitalize()),
        _line("Direction", code[-2] if code[-2] in "XYZR" else NOVALUE),
        _line("Channel frequency class", channel.filtered.removeprefix("CFC ")),
        _line("Unit", _UNIT.get(unit, unit)),
        _line("Reference system", NOVALUE),
        _line("Channel amplitude class", NOVALUE),
        _line("Sampling interval", f"{recording.interval:.9g}"),
        _line("Bit resolution", NOVALUE),
        _line("Time of first sample", f"{recording.time[0]:.9g}"),
        _line("Number of samples", str(recording.time.size)),
        _line("Reference channel", "implicit"),
        _line("Data source", "transducer" if recording.kind == "measured" else "simulation"),
        _line("Data status", "ok"),
    ]
    values = channel.values * channel.dimension.scale
    return "".join(head) + "".join(f"{value:.9g}\n" for value in values.tolist())


def _zipped(files: Lookup[str, str]) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(files):
            entry = zipfile.ZipInfo(path, date_time=_EPOCH)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, files[path].encode())
    return buffer.getvalue()
