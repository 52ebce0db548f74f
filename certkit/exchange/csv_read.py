"""Read a CSV recording: certkit's own `channels.csv` as it is, any other with a mapping file."""

from __future__ import annotations

import hashlib
import math
from types import MappingProxyType
from typing import TYPE_CHECKING

from certkit.definitions.loading.channel_tables import default_channels
from certkit.definitions.units import parse_quantity
from certkit.errors import DataError
from certkit.exchange.channels_csv import (
    CsvHead,
    column_names,
    read_head,
    told_conditions,
    told_filter,
    told_kind,
)
from certkit.exchange.codes import CodeTable, code_table
from certkit.exchange.conditions import mapped_conditions, together
from certkit.exchange.csv_table import CsvTable, cut
from certkit.exchange.data_status import judged
from certkit.exchange.data_units import any_factor, factor, quantity
from certkit.exchange.leniency import Leniency
from certkit.exchange.measured import MeasuredData, SourceFile
from certkit.exchange.samples import read_samples, read_with_gaps
from certkit.exchange.text import decode
from certkit.exchange.timebase import TimeBase, base_of_times
from certkit.files.bounded import read_bounded
from certkit.signals.clipping import beyond_class, find_clipping
from certkit.signals.recording import Channel, Recording

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from pathlib import Path

    import numpy as np
    from numpy.typing import NDArray

    from certkit.definitions.channel_mapping import Column, CsvLayout, Mapping, TimeColumn
    from certkit.definitions.channels import ChannelKind, ChannelTable
    from certkit.reasons import Reason


def read_csv(
    path: Path,
    mapping: Mapping | None = None,
    *,
    lenient: bool = False,
    tables: Sequence[ChannelTable] = (),
) -> MeasuredData:
    """Read a CSV recording.

    Parameters
    ----------
    path : Path
        The file.
    mapping : Mapping, optional
        Which column is what. Without one, heads are read as certkit writes them: `time [s],T1 [N·m],…`.
    lenient : bool
        List assumptions instead of stopping at departures.
    tables : sequence of ChannelTable
        Legforms that it may be a test of; its heads tell which. The shipped one when empty.

    Raises
    ------
    DataError
        One line that says what is wrong, where, and what to do.
    """
    leniency = Leniency(lenient=lenient)
    data = read_bounded(path)
    if not data.strip():
        raise DataError(f"{path}: is empty; export the test again")
    text, _ = decode(data, str(path))
    layout = mapping.csv if mapping else None
    table = cut(text, str(path), layout)
    known = _legform(layout.columns if layout else column_names(table), tables or (default_channels(),))
    codes = code_table(mapping, known)
    head = read_head(table, known, leniency) if layout is None else _mapped_head(table, layout, codes)
    refused, doubts = _status(table, known)
    time, columns = head.time, head.columns
    wanted = {
        name: table.column(columns[name].column)
        for name in known.kinds
        if name in columns and name not in refused
    }
    base, values = _values(table, time, wanted, leniency)
    channels = {name: _channel(table, known.kinds[name], columns[name], values[name]) for name in values}
    told = together(head.conditions, mapped_conditions(mapping, codes))
    recording = Recording(
        kind=head.kind,
        time=base.times(),
        channels=MappingProxyType(channels),
        conditions=MappingProxyType({word: item.value for word, item in told.items()}),
        notes=(*head.notes, *refused.values(), *doubts, *leniency.assumptions),
        source=path.name,
        table=known,
    )
    source = SourceFile(path.name, hashlib.sha256(data).hexdigest())
    return MeasuredData(recording, (source,), tuple(leniency.assumptions), _shown(table), told)


def _shown(table: CsvTable) -> dict[str, str]:
    """Return what the table says of the test that it is of."""
    return {word: table.remarks[word][0] for word in ("procedure",) if word in table.remarks}


def _mapped_head(table: CsvTable, layout: CsvLayout, codes: CodeTable) -> CsvHead:
    """Return what a mapping file says of a laboratory's table, whose `#` lines must not contradict it."""
    for name, column in layout.columns.items():
        told = told_filter(table, name)
        if told is not None and told != column.filter:
            line = table.remarks[f"filter {name}"][1]
            raise DataError(
                f"{table.place}:{line}: {name} was filtered with {told}, the mapping says {column.filter}; "
                "correct one of them"
            )
    kind = told_kind(table) or "measured"
    return CsvHead(kind, layout.time, dict(layout.columns), told_conditions(table, codes))


def _status(table: CsvTable, known: ChannelTable) -> tuple[dict[str, Reason], list[Reason]]:
    """Understand lines such as `# data status T1: channel failed`; without a channel they mean the file.

    Raises
    ------
    DataError
        When the data of the whole file are not good.
    """
    refused: dict[str, Reason] = {}
    doubts: list[Reason] = []
    for word, (text, line) in table.remarks.items():
        channel = word[len("data status") :].strip()
        if not word.casefold().startswith("data status") or (channel and channel not in known.kinds):
            continue
        place = f"{table.place}:{line}"
        bad, told = judged(text, place, channel)
        if bad is not None and not channel:
            raise DataError(
                f"{place}: data status is `{text[:60]}`; a test whose data are not `ok` is not read: "
                "repeat it"
            )
        if bad is not None:
            refused[channel] = bad
        doubts += told
    return refused, doubts


def _legform(names: Collection[str], tables: Sequence[ChannelTable]) -> ChannelTable:
    """Return the legform that most of the names are channels of; the first of equals."""
    return max(tables, key=lambda known: sum(name in known.kinds for name in names))


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
        raise DataError(f"{table.place}: no channel that may be used is left; export the test again")
    return base, found


def _base(table: CsvTable, time: TimeColumn, values: NDArray[np.float64]) -> TimeBase:
    if time.column is None:
        if time.sampling_interval is None:
            raise DataError(
                f"{table.place}: the mapping has neither a time column nor a sampling interval; name one"
            )
        interval = parse_quantity(time.sampling_interval, "time")
        return TimeBase(parse_quantity(time.first_sample, "time"), interval, values.shape[0])
    try:
        scale = quantity("1", "time", time.unit)
    except ValueError as error:
        raise DataError(f"{table.head_place}: time: {error}; correct the unit") from error
    _same_unit(table, table.column(time.column), "time", "time", time.unit)
    return base_of_times(values[:, 0] * scale, table.place, table.body.first)


def _same_unit(table: CsvTable, index: int, name: str, dimension: str, unit: str) -> None:
    """Refuse a unit of the mapping that the table's own head or row of units contradicts."""
    for told, line in table.units[index] if index < len(table.units) else ():
        factors = any_factor(told)
        if factors and not math.isclose(factors.get(dimension, 0.0), any_factor(unit)[dimension]):
            raise DataError(
                f"{table.place}:{line}: {name} is in {told} here, in {unit} in the mapping; "
                "correct one of them"
            )


def _channel(table: CsvTable, kind: ChannelKind, column: Column, values: NDArray[np.float64]) -> Channel:
    name = kind.name
    try:
        scale = factor(column.unit, kind)
        limit = quantity(column.amplitude_class, kind.dimension.quantity) if column.amplitude_class else None
    except ValueError as error:
        raise DataError(f"{table.head_place}: {name}: {error}; correct the unit") from error
    _same_unit(table, table.column(column.column), name, kind.dimension.quantity, column.unit)
    values = values * (scale * column.sign)
    clipped = find_clipping(values, limit) if limit else None
    if clipped is not None:
        line = table.body.first + clipped.index
        raise DataError(
            f"{table.place}:{line}: {name} is clipped at its amplitude class "
            f"{column.amplitude_class}; the peak is lost: leave the channel out, or repeat the test"
        )
    over = beyond_class(values, limit) if limit else None
    if over is not None:
        raise DataError(
            f"{table.place}:{table.body.first + over.index}: {name} goes beyond its amplitude class "
            f"{column.amplitude_class}; nothing vouches for it there: correct the class, or leave it "
            "out"
        )
    filtered = "" if column.filter == "none" else column.filter
    return Channel(name, kind.title, kind.dimension, values, filtered=filtered)
