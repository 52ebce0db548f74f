"""Read a finite-element run as a recording: the mapping says which histories are the legform's channels."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.channels import SPEED
from certkit.documents.rounding import rounded_series
from certkit.errors import DataError
from certkit.exchange.codes import code_table
from certkit.exchange.conditions import Told, mapped_conditions, together
from certkit.exchange.fe.readers import open_run, usual_files
from certkit.exchange.fe.run_conditions import FREE_FLIGHT, contact_sample, energy_conditions
from certkit.exchange.measured import MeasuredData, SourceFile
from certkit.exchange.timebase import TimeBase
from certkit.files.limits import MAX_SAMPLES
from certkit.reasons import Reason
from certkit.signals.recording import Channel, Recording

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from certkit.definitions.channel_mapping import Mapping
    from certkit.definitions.channels import ChannelTable
    from certkit.definitions.virtual_test import FiniteElements
    from certkit.exchange.fe.run_histories import Samples


def read_run(path: Path, mapping: Mapping, layout: FiniteElements, table: ChannelTable) -> MeasuredData:
    """Read a run.

    Parameters
    ----------
    path : Path
        The run's folder, or its file.
    mapping : Mapping
        With the conditions that the files do not tell.
    layout : FiniteElements
        Its section on the run.
    table : ChannelTable
        Channels of the legform.

    Returns
    -------
    MeasuredData
        Its recording is `virtual`: on even steps by linear interpolation, time zero at first contact, with
        what the run tells of its own quality among the conditions.

    Raises
    ------
    DataError
        For missing or damaged files, histories that are not there, or conditions that contradict each other.
    """
    paths = _paths(path, layout)
    with open_run(paths, layout) as run:
        histories = {
            name: _signed(run.history(asked, table.kinds[name].dimension.quantity), asked.sign)
            for name, asked in layout.channels.items()
        }
        energies = run.energies()
        speed = None if layout.speed is None else run.history(layout.speed, SPEED.quantity)
    base = _base(list(histories.values()), str(path))
    time = base.times()
    values = {name: np.array(rounded_series(each.at(time))) for name, each in histories.items()}
    contact = next((values[name] for name in table.contact if name in values and "force" in name), None)
    zero = None if contact is None else contact_sample(contact)
    notes = [Reason.of("run-resampled", interval=base.interval * 1e3)]
    told: dict[str, Told] = {word: Told(v, str(path)) for word, v in energy_conditions(energies).items()}
    notes += [Reason.of("run-files-remark", said=said) for said in run.remarks]
    if zero is None:
        notes.append(Reason.of("run-without-contact"))
        shift = 0.0
    else:
        shift = float(time[zero])
        told[FREE_FLIGHT] = Told(zero * base.interval, str(path))
    if speed is not None:
        told["speed"] = Told(abs(float(speed.at(np.array([shift]))[0])), str(path))
    told = together(told, mapped_conditions(mapping, code_table(mapping, table)))
    moved = TimeBase(base.first - shift, base.interval, base.count)
    recording = Recording(
        kind="virtual",
        time=moved.times(),
        channels=MappingProxyType(
            {n: Channel(n, table.kinds[n].title, table.kinds[n].dimension, v) for n, v in values.items()}
        ),
        conditions=MappingProxyType({word: item.value for word, item in told.items()}),
        notes=tuple(notes),
        source=path.name,
        table=table,
    )
    files = sorted((_inside(path, name), digest) for name, digest in run.files.items())
    return MeasuredData(
        recording,
        tuple(SourceFile(name, digest) for name, digest in files),
        told=told,
        energies={
            name: each.at(recording.time + shift)
            for name, each in energies.items()
            if name not in {"ratio", "mass", "added mass"}
        },
    )


def _signed(samples: Samples, sign: int) -> Samples:
    return samples if sign == 1 else type(samples)(samples.time, -samples.values)


def _base(histories: Sequence[Samples], source: str) -> TimeBase:
    """Return even steps, as fine as the finest history's mean, over the time that all cover."""
    begin = max(float(each.time[0]) for each in histories)
    end = min(float(each.time[-1]) for each in histories)
    step = min(float(each.time[-1] - each.time[0]) / (each.time.size - 1) for each in histories)
    plain = TimeBase(begin, step, 2)
    count = int((end - plain.first) / plain.interval + 1e-6) + 1 if end > begin else 0
    if not 2 <= count <= MAX_SAMPLES:
        raise DataError(f"{source}: its histories share no time; are they of one run?")
    return plain.with_count(count)


def _paths(path: Path, layout: FiniteElements) -> list[Path]:
    """Return the run's files: the one that is named, or those in the folder that is."""
    if not path.is_dir():
        return [path]
    patterns = layout.files
    if not patterns:
        usual = usual_files(layout.format)
        for each in usual:
            found = _found(path, each)
            if found:
                return found
        known = ", ".join(pattern for each in usual for pattern in each)
        raise DataError(
            f"{path}: none of a run's usual files ({known or 'this format has none'}) is in this folder; "
            "name the mapping's `files`"
        )
    found = _found(path, patterns)
    missing = [pattern for pattern in patterns if not _found(path, [pattern])]
    if missing:
        raise DataError(f"{path}: there is no `{missing[0]}` in this folder; correct the mapping's `files`")
    return found


def _found(folder: Path, patterns: Sequence[str]) -> list[Path]:
    """Return the folder's files of these patterns, in their order; continued binouts go with their first."""
    found = [each for pattern in patterns for each in sorted(folder.glob(pattern)) if each.is_file()]
    inside = [each for each in found if each.resolve().is_relative_to(folder.resolve())]
    return [each for each in dict.fromkeys(inside) if "%" not in each.name]


def _inside(path: Path, name: str) -> str:
    """Return a file's name without the folders above the run."""
    return name.removeprefix(f"{path}/") if path.is_dir() else name.rpartition("/")[2]
