"""Read a CSV recording: certkit's own `channels.csv` as it is, any other with a mapping file."""

from __future__ import annotations

import csv
import hashlib
import re
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

from certkit.definitions.mapping import Column, CsvLayout, Mapping, TimeColumn
from certkit.definitions.quantities import parse_quantity
from certkit.definitions.vocabulary import CHANNELS
from certkit.errors import DataError
from certkit.exchange.codes import CodeTable, code_table
from certkit.exchange.conditions import mapped_conditions, read_condition
from certkit.exchange.container import read_bounded
from certkit.exchange.limits import MAX_CHANNELS, MAX_LINE, MAX_SAMPLES
from certkit.exchange.measured import Leniency, Measured, SourceFile
from certkit.exchange.samples import read_samples
from certkit.exchange.text import decode
from certkit.exchange.timebase import TimeBase, base_of_times
from certkit.exchange.units import factor, quantity, table_dimension
from certkit.signals.clipping import find_clipping
from certkit.signals.recording import Channel, Kind, Recording

if TYPE_CHECKING:
    from pathlib import Path

    import numpy as np
    from numpy.typing import NDArray

_HEAD = re.compile(r"(.+?)\s*[\[(]([^\])]*)[\])]")
_REMARK = re.compile(r"#\s*([A-Za-z][A-Za-z0-9 ]*?)\s*:\s*(.+)")


@dataclass(frozen=True)
class _Table:
    """The file cut into heads and numbers.

    `remarks` are the `# word: value` lines before the heads, with their line numbers.
    """

    place: str
    heads: list[str]
    head_line: int
    values: NDArray[np.float64]
    first_line: int
    remarks: dict[str, tuple[str, int]]

    def column(self, wanted: str | int) -> int:
        """Return the index of a column by its head or its number from 1.

        Raises
        ------
        DataError
            When there is none, or several.
        """
        if isinstance(wanted, int):
            if not 1 <= wanted <= self.values.shape[1]:
                raise DataError(
                    f"{self.place}:{self.head_line}: no column {wanted}; there are {self.values.shape[1]}"
                )
            return wanted - 1
        found = [i for i, head in enumerate(self.heads) if head == wanted]
        if len(found) != 1:
            what = "stands twice" if found else f"is not among them ({', '.join(self.heads[:12])})"
            raise DataError(f"{self.place}:{self.head_line}: the column head `{wanted}` {what}")
        return found[0]


def read_csv(path: Path, mapping: Mapping | None = None, *, lenient: bool = False) -> Measured:
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
    table = _cut(text, str(path), layout)
    codes = code_table(mapping)
    if layout is None:
        time, columns, notes = _own_heads(table, leniency)
    else:
        time, columns, notes = layout.time, dict(layout.columns), []
    base = _base(table, time)
    channels = {name: _channel(table, name, columns[name]) for name in CHANNELS if name in columns}
    recording = Recording(
        kind=_kind(table),
        time=base.times(),
        channels=MappingProxyType(channels),
        conditions=MappingProxyType(_conditions(table, codes) | mapped_conditions(mapping, codes)),
        notes=(*notes, *leniency.assumptions),
        source=path.name,
    )
    source = SourceFile(path.name, hashlib.sha256(data).hexdigest())
    return Measured(recording, (source,), tuple(leniency.assumptions))


def _cut(text: str, place: str, layout: CsvLayout | None) -> _Table:
    delimiter = "," if layout is None else {"tab": "\t"}.get(layout.delimiter, layout.delimiter)
    lines = text.split("\n")
    long = next((n for n, line in enumerate(lines, 1) if len(line) > 20 * MAX_LINE), None)
    if long:
        raise DataError(
            f"{place}:{long}: a line of {len(lines[long - 1])} characters; this is no table of channels"
        )
    if len(lines) > MAX_SAMPLES:
        raise DataError(f"{place}: more than {MAX_SAMPLES} lines are refused")
    remarks = {}
    head = 0
    while layout is None and head < len(lines) and lines[head].startswith("#"):
        if match := _REMARK.fullmatch(lines[head].strip()):
            remarks[match.group(1)] = (match.group(2), head + 1)
        head += 1
    if layout is not None:
        head = layout.head - 1  # -1: no heads, columns go by number
    if head >= len(lines):
        raise DataError(f"{place}:{len(lines)}: the file ends before its column heads")
    first = head + 1 + (layout.skip if layout else 0)
    heads = next(csv.reader([lines[head]], delimiter=delimiter)) if head >= 0 else []
    body = lines[first:]
    if layout is not None and layout.decimal == ",":
        if delimiter == ",":
            raise DataError(
                f"{place}: the mapping makes the comma both delimiter and decimal sign; name the delimiter"
            )
        body = [line.replace(",", ".") for line in body]
    count = len(heads) or (body[0].count(delimiter) + 1 if body else 0)
    if count > MAX_CHANNELS:
        raise DataError(f"{place}:{head + 1}: {count} columns; more than {MAX_CHANNELS} are refused")
    values = read_samples(body, place, first + 1, columns=count, delimiter=delimiter)
    return _Table(place, [h.strip() for h in heads], max(head, 0) + 1, values, first + 1, remarks)


def _own_heads(table: _Table, leniency: Leniency) -> tuple[TimeColumn, dict[str, Column], list[str]]:
    """Understand heads such as `time [s]` and `T1 [N·m]`."""
    place = f"{table.place}:{table.head_line}"
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
            filtered = table.remarks.get(f"filter {name}", ("none", 0))[0]
            columns[name] = Column.model_validate({"column": number, "unit": unit, "filter": filtered})
    if time is None:
        raise DataError(f"{place}: no column `time [s]`")
    if not columns:
        raise DataError(f"{place}: no channel of a Flex-PLI among the heads; other files need --mapping")
    if unused:
        leniency.depart(place, f"unknown channel `{unused[0]}`", "the column is not needed")
    return time, columns, []


def _base(table: _Table, time: TimeColumn) -> TimeBase:
    if time.column is None:
        if time.sampling_interval is None:
            raise DataError(f"{table.place}: the mapping has neither a time column nor a sampling interval")
        interval = parse_quantity(time.sampling_interval, "time")
        return TimeBase(parse_quantity(time.first_sample, "time"), interval, table.values.shape[0])
    times = table.values[:, table.column(time.column)]
    try:
        scale = quantity("1", "time", time.unit)
    except ValueError as error:
        raise DataError(f"{table.place}:{table.head_line}: time: {error}") from error
    return base_of_times(times * scale, table.place, table.first_line)


def _channel(table: _Table, name: str, column: Column) -> Channel:
    kind = CHANNELS[name]
    try:
        scale = factor(column.unit, kind)
        limit = quantity(column.amplitude_class, table_dimension(kind)) if column.amplitude_class else None
    except ValueError as error:
        raise DataError(f"{table.place}:{table.head_line}: {name}: {error}") from error
    values = table.values[:, table.column(column.column)] * (scale * column.sign)
    clipped = find_clipping(values, limit) if limit else None
    if clipped is not None:
        line = table.first_line + clipped.index
        raise DataError(
            f"{table.place}:{line}: {name} is clipped at its amplitude class "
            f"{column.amplitude_class}; the peak is lost"
        )
    filtered = "" if column.filter == "none" else column.filter
    return Channel(name, kind.title, kind.dimension, values, filtered=filtered)


def _kind(table: _Table) -> Kind:
    return "simulated" if table.remarks.get("kind", ("", 0))[0] == "simulated" else "measured"


def _conditions(table: _Table, codes: CodeTable) -> dict[str, float]:
    found = {}
    for word, (text, line) in table.remarks.items():
        if word in codes.conditions:
            try:
                found[word] = read_condition(word, text, codes)
            except ValueError as error:
                raise DataError(f"{table.place}:{line}: {word}: {error}") from error
    return found
