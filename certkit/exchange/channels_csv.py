"""certkit's own CSV of channels: the one writer of it, and the reading of its head.

```
# kind: simulated
# procedure: pendulum
# result: 3F9A-1C07-8B2E-44D1
# release angle: 0.261799388 rad
# filter T1: CFC 180
time [s],T1 [N·m],MCL [mm]
0,0,0
```

The lines with `#` say what the file is: kind of test, procedure, the id of its result, conditions in SI, and
the filter that a channel has already seen. Below stand the time in seconds and one column a channel, its unit
in the head; a missing value is an empty cell. No cell of the head begins a formula where a spreadsheet opens
it: such a name is written behind an apostrophe, as spreadsheets do themselves.
"""

from __future__ import annotations

import csv
import io
import re
from typing import TYPE_CHECKING, get_args

import numpy as np
from msgspec import Struct, field

from certkit.definitions.channel_mapping import Column, TimeColumn
from certkit.definitions.filters import Filter
from certkit.definitions.units import UNITS
from certkit.documents.channel_curves import recording_of
from certkit.documents.rounding import SIGNIFICANT_DIGITS
from certkit.errors import DataError
from certkit.exchange.codes import CodeTable, code_table
from certkit.exchange.conditions import Told, known_word, read_condition, together
from certkit.exchange.csv_cells import harmless
from certkit.reasons import Reason
from certkit.signals.recording import RecordingKind

if TYPE_CHECKING:
    from collections.abc import Iterator

    from certkit.definitions.channels import ChannelTable
    from certkit.documents.result import Result
    from certkit.exchange.csv_table import CsvTable
    from certkit.exchange.leniency import Leniency
    from certkit.signals.recording import Recording

KINDS: tuple[RecordingKind, ...] = get_args(RecordingKind)
FILTER_WORDS: tuple[Filter, ...] = get_args(Filter)

DIGITS = 9
"""Significant digits of a recording; a result's channels have those of its document."""

_HEAD = re.compile(r"(.+?)\s*[\[(]([^\])]*)[\])]")


class CsvHead(Struct, frozen=True):
    """What is known of a table before its numbers are read.

    Parameters
    ----------
    kind : {'simulated', 'measured'}
    time : TimeColumn
    columns : dict of str to Column
        By channel.
    conditions : dict of str to Told
        With their places.
    notes : tuple of Reason
        What was assumed because the head does not say it.
    """

    kind: RecordingKind
    time: TimeColumn
    columns: dict[str, Column]
    conditions: dict[str, Told] = field(default_factory=dict)
    notes: tuple[Reason, ...] = ()


def channels_csv(result: Result) -> str | None:
    """Return the channels of a result as CSV, with the digits of its document; None where it carries none."""
    if result.channels is None:
        return None
    recording = recording_of(result)
    return csv_text(recording, procedure=result.procedure, result_id=result.id, digits=SIGNIFICANT_DIGITS)


def csv_text(recording: Recording, *, procedure: str = "", result_id: str = "", digits: int = DIGITS) -> str:
    """Return a recording as CSV; `read_csv` reads it without a mapping file.

    Parameters
    ----------
    recording : Recording
    procedure : str
        By which it was made or graded; left out when empty.
    result_id : str
        The id of the result whose channels they are, likewise.
    digits : int
        Significant digits of the values; the time always has nine.
    """
    remarks = [("kind", recording.kind), ("procedure", procedure), ("result", result_id)]
    remarks += _conditions(recording)
    channels = list(recording.channels.values())
    remarks += [(f"filter {channel.name}", channel.filtered) for channel in channels]
    head = "".join(f"# {_plain(word)}: {_plain(said)}\n" for word, said in remarks if said)
    names = io.StringIO()
    # A comma in a name is kept in quotes; a semicolon would begin a cell where a spreadsheet goes by it.
    heads = [f"{each.name.replace(';', ' ')} [{each.dimension.unit}]" for each in channels]
    cells = ["time [s]", *map(harmless, heads)]
    csv.writer(names, lineterminator="\n").writerow(cells)
    # Steps are added up from the first sample: without rounding, zero would be 1e-18.
    columns = [np.round(recording.time, 12), *(each.values * each.dimension.scale for each in channels)]
    form = ",".join(["%.9g", *[f"%.{digits}g"] * len(channels)]) + "\n"
    rows = "".join([form % tuple(row) for row in np.column_stack(columns).tolist()])
    return (
        head + names.getvalue() + (re.sub(r"(?<![^,\n])nan(?![^,\n])", "", rows) if "nan" in rows else rows)
    )


def column_names(table: CsvTable) -> list[str]:
    """Return what the heads of a table name, without their units."""
    found = [_HEAD.fullmatch(head.removeprefix("'")) for head in table.heads]
    return [match.group(1).strip() for match in found if match is not None]


def read_head(table: CsvTable, known: ChannelTable, leniency: Leniency) -> CsvHead:
    """Understand the head of certkit's own CSV: `#` lines, then heads such as `time [s]` and `T1 [N·m]`.

    `known` are the channels of the legform that was tested.

    Raises
    ------
    DataError
        When a head has no unit, a column is missing or stands twice, or a `#` line says what cannot be.
    """
    place = table.head_place
    time, columns, unused = None, {}, []
    for number, head in enumerate(table.heads, 1):
        match = _HEAD.fullmatch(head.removeprefix("'"))
        if match is None:
            hint = "certkit's own heads look like `T1 [N·m]`; other files need --mapping"
            raise DataError(f"{place}: the column head `{head[:60]}` has no unit; {hint}")
        name, unit = match.group(1).strip(), match.group(2).strip()
        if name == "time":
            time = TimeColumn(column=number, unit=unit)
        elif name not in known.kinds:
            unused.append(name)
        elif name in columns:
            raise DataError(f"{place}: the column `{name}` stands twice; leave one out")
        else:
            columns[name] = Column(column=number, unit=unit, filter=told_filter(table, name) or "none")
    if time is None:
        raise DataError(f"{place}: no column `time [s]`; write its head so, or use --mapping")
    if not columns:
        raise DataError(
            f"{place}: no channel of a {known.impactor} among the heads; other files need --mapping"
        )
    if unused:
        leniency.depart(place, f"unknown channel `{unused[0][:60]}`", "the column is not needed")
    kind = told_kind(table)
    notes = () if kind else (Reason.of("kind-not-said", file=table.place),)
    return CsvHead(
        kind or "measured", time, columns, told_conditions(table, code_table(channels=known)), notes
    )


def told_kind(table: CsvTable) -> RecordingKind | None:
    """Return the kind of test that a `# kind:` line names; None where there is none."""
    said, line = table.remarks.get("kind", ("", 0))
    if said and said not in KINDS:
        raise DataError(
            f"{table.place}:{line}: no kind of test is `{said[:40]}`; write one of {', '.join(KINDS)}"
        )
    return next((kind for kind in KINDS if kind == said), None)


def _conditions(recording: Recording) -> Iterator[tuple[str, str]]:
    table = code_table(channels=recording.table)
    for word, value in sorted(recording.conditions.items()):
        if word in table.conditions:
            units = UNITS[table.conditions[word].dimension]
            unit = next(unit for unit, scale in units.items() if scale == 1.0)
            yield word, f"{value:.9g} {unit}".rstrip()


def told_conditions(table: CsvTable, codes: CodeTable) -> dict[str, Told]:
    """Return the conditions that `#` lines tell."""
    found: dict[str, Told] = {}
    for written, (text, line) in table.remarks.items():
        word = known_word(written, codes)
        if word in codes.conditions:
            try:
                told = Told(read_condition(word, text, codes), f"{table.place}:{line}")
            except ValueError as error:
                raise DataError(f"{table.place}:{line}: {word}: {error}; correct the line") from error
            found = together(found, {word: told})
    return found


def told_filter(table: CsvTable, name: str) -> Filter | None:
    """Return the filter that a remark `# filter T1: CFC 180` names; None where there is none."""
    if f"filter {name}" not in table.remarks:
        return None
    text, line = table.remarks[f"filter {name}"]
    known = next((word for word in FILTER_WORDS if word == text), None)
    if known is None:
        raise DataError(
            f"{table.place}:{line}: no filter is called `{text[:40]}`; write one of {', '.join(FILTER_WORDS)}"
        )
    return known


def _plain(text: str) -> str:
    """Keep a remark in one line and one cell, whatever separates cells where it is opened."""
    return re.sub(r"[\s,;]+", " ", text).strip()
