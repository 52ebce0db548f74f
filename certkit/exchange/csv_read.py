"""Read a CSV recording: certkit's own `channels.csv` as it is, any other with a mapping file."""

from __future__ import annotations

import hashlib
import re
from types import MappingProxyType
from typing import TYPE_CHECKING, get_args

from certkit.definitions.channel_mapping import Column, Filter, Mapping, TimeColumn
from certkit.definitions.channels import CHANNELS
from certkit.definitions.units import parse_quantity
from certkit.errors import DataError
from certkit.exchange.codes import CodeTable, code_table
from certkit.exchange.conditions import mapped_conditions, read_condition
from certkit.exchange.container import read_bounded
from certkit.exchange.csv_table import CsvTable, cut
from certkit.exchange.data_units import factor, quantity, table_dimension
from certkit.exchange.measured import Leniency, MeasuredData, SourceFile
from certkit.exchange.samples import read_samples, read_with_gaps
from certkit.exchange.text import decode
from certkit.exchange.timebase import TimeBase, base_of_times
from certkit.signals.clipping import find_clipping
from certkit.signals.recording import Channel, Kind, Recording

if TYPE_CHECKING:
    from pathlib import Path

    import numpy as np
    from numpy.typing import NDArray

FILTERS: tuple[Filter, ...] = get_args(Filter)

_HEAD = re.compile(r"(.+?)\s*[\[(]([^\])]*)[\])]")


def read_csv(path: Path, mapping: Mapping | None = None, *, lenient: bool = False) -> MeasuredData:
    """Read a CSV recording.

    Parameters
    ----------
    path : Path
        The file.
    mapping : Mapping, optional
        Which column is what. Without one, heads are read as certkit writes them: `time [s],T1 [N·m],…`.
    lenient : bool
        List assumptions instead of stopping at departures.

    Raises
    ------
    DataError
        One line that says what is wrong, where, and what to do.
    """
    leniency = Leniency(lenient=lenient)
    data = read_bounded(path)
    if not data.strip():
        raise DataError(f"{path}: is empty")
    text, _ = decode(data, str(path))
    layout = mapping.csv if mapping else None
    table = cut(text, str(path), layout)
    codes = code_table(mapping)
    time, columns = (layout.time, dict(layout.columns)) if layout else _own_heads(table, leniency)
    wanted = {name: table.column(columns[name].column) for name in CHANNELS if name in columns}
    base, values = _values(table, time, wanted, leniency)
    channels = {name: _channel(table, name, columns[name], values[name]) for name in values}
    recording = Recording(
        kind=_kind(table),
        time=base.times(),
        channels=MappingProxyType(channels),
        conditions=MappingProxyType(_conditions(table, codes) | mapped_conditions(mapping, codes)),
        notes=tuple(leniency.assumptions),
        source=path.name,
    )
    source = SourceFile(path.name, hashlib.sha256(data).hexdigest())
    return MeasuredData(recording, (source,), tuple(leniency.assumptions))


def _own_heads(table: CsvTable, leniency: Leniency) -> tuple[TimeColumn, dict[str, Column]]:
    """Understand heads such as `time [s]` and `T1 [N·m]`."""
    place = table.head_place
    time, columns, unused = None, {}, []
    for number, head in enumerate(table.heads, 1):
        match = _HEAD.fullmatch(head)
        if match is None:
            hint = "certkit's own heads look like `T1 [N·m]`; other files need --mapping"
            raise DataError(f"{place}: the column head `{head[:60]}` has no unit; {hint}")
        name, unit = match.group(1).strip(), match.group(2).strip()
        if name == "time":
            time = TimeColumn(column=number, unit=unit)
        elif name not in CHANNELS:
            unused.append(name)
        elif name in columns:
            raise DataError(f"{place}: the column `{name}` stands twice")
        else:
            columns[name] = Column(column=number, unit=unit, filter=_filter(table, name))
    if time is None:
        raise DataError(f"{place}: no column `time [s]`")
    if not columns:
        raise DataError(f"{place}: no channel of a Flex-PLI among the heads; other files need --mapping")
    if unused:
        leniency.depart(place, f"unknown channel `{unused[0][:60]}`", "the column is not needed")
    return time, columns


def _filter(table: CsvTable, name: str) -> Filter:
    """Return the filter that a remark `# filter T1: CFC 180` names."""
    text, line = table.remarks.get(f"filter {name}", ("none", 0))
    known = next((word for word in FILTERS if word == text), None)
    if known is None:
        raise DataError(
            f"{table.place}:{line}: no filter is called `{text[:40]}`; there are {', '.join(FILTERS)}"
        )
    return known


def _values(
    table: CsvTable, time: TimeColumn, wanted: dict[str, int], leniency: Leniency
) -> tuple[TimeBase, dict[str, NDArray[np.float64]]]:
    """Read the time axis and the wanted columns, in the file's units."""
    clock = [] if time.column is None else [table.column(time.column)]
    use = [*clock, *wanted.values()]
    faults: dict[int, str] = {}
    try:
        values = read_samples(table.body, use)
    except DataError:
        if not leniency.lenient:
            raise
        values, faults = read_with_gaps(table.body, use)
    if clock and clock[0] in faults:
        raise DataError(faults[clock[0]])
    base = _base(table, time, values)
    found = {}
    for place, (name, column) in enumerate(wanted.items(), len(clock)):
        if column in faults:
            leniency.leave_out(faults[column], name)
        else:
            found[name] = values[:, place]
    if not found:
        raise DataError(f"{table.place}: no channel without gaps is left")
    return base, found


def _base(table: CsvTable, time: TimeColumn, values: NDArray[np.float64]) -> TimeBase:
    if time.column is None:
        if time.sampling_interval is None:
            raise DataError(f"{table.place}: the mapping has neither a time column nor a sampling interval")
        interval = parse_quantity(time.sampling_interval, "time")
        return TimeBase(parse_quantity(time.first_sample, "time"), interval, values.shape[0])
    try:
        scale = quantity("1", "time", time.unit)
    except ValueError as error:
        raise DataError(f"{table.head_place}: time: {error}") from error
    return base_of_times(values[:, 0] * scale, table.place, table.body.first)


def _channel(table: CsvTable, name: str, column: Column, values: NDArray[np.float64]) -> Channel:
    kind = CHANNELS[name]
    try:
        scale = factor(column.unit, kind)
        limit = quantity(column.amplitude_class, table_dimension(kind)) if column.amplitude_class else None
    except ValueError as error:
        raise DataError(f"{table.head_place}: {name}: {error}") from error
    values = values * (scale * column.sign)
    clipped = find_clipping(values, limit) if limit else None
    if clipped is not None:
        line = table.body.first + clipped.index
        raise DataError(
            f"{table.place}:{line}: {name} is clipped at its amplitude class "
            f"{column.amplitude_class}; the peak is lost"
        )
    filtered = "" if column.filter == "none" else column.filter
    return Channel(name, kind.title, kind.dimension, values, filtered=filtered)


def _kind(table: CsvTable) -> Kind:
    return "simulated" if table.remarks.get("kind", ("", 0))[0] == "simulated" else "measured"


def _conditions(table: CsvTable, codes: CodeTable) -> dict[str, float]:
    found = {}
    for word, (text, line) in table.remarks.items():
        if word in codes.conditions:
            try:
                found[word] = read_condition(word, text, codes)
            except ValueError as error:
                raise DataError(f"{table.place}:{line}: {word}: {error}") from error
    return found
