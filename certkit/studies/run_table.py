"""The table of a study: one row a run, in the order of the design, whatever order the runs ended in."""

from __future__ import annotations

import io
import json
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from certkit.errors import UsageError
from certkit.files import write_whole

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence
    from pathlib import Path

    import pandas as pd

    from certkit.studies.points import Outcome, Point

RUN = "run"
ERROR = "error"
FORMATS = ("csv", "json", "parquet")


def table_of(points: Sequence[Point], outcomes: Sequence[Outcome]) -> pd.DataFrame:
    """Put points and outcomes side by side.

    Returns
    -------
    DataFrame
        Columns `run` (from 1), the parameters, the outputs in the order of the first run that has them,
        `error` (empty where there is none). Missing numbers are NaN.
    """
    import pandas as pd  # noqa: PLC0415  # slow to import

    inputs = list(points[0]) if points else []
    outputs = list(dict.fromkeys(name for outcome in outcomes for name in outcome.outputs))
    rows = [
        {RUN: number, **point, **outcome.outputs, ERROR: outcome.error}
        for number, (point, outcome) in enumerate(zip(points, outcomes, strict=True), 1)
    ]
    table = pd.DataFrame(rows, columns=[RUN, *inputs, *outputs, ERROR])
    for name in outputs:
        column = table[name]
        if not column.map(lambda value: isinstance(value, str)).any():
            table[name] = pd.to_numeric(column)
    return table


def check_formats(formats: Collection[str]) -> None:
    """Refuse formats that cannot be written, before anything is run.

    Raises
    ------
    UsageError
        For a format that is not known, or Parquet without its package.
    """
    unknown = sorted(set(formats) - set(FORMATS))
    if unknown:
        raise UsageError(f"`{unknown[0]}` is no format of a table; there are {', '.join(FORMATS)}")
    if "parquet" in formats and find_spec("pyarrow") is None:
        raise UsageError("Parquet needs pyarrow: pip install 'certkit[parquet]'")


def write_table(
    table: pd.DataFrame, folder: Path, name: str, units: Mapping[str, str], formats: Collection[str]
) -> list[Path]:
    """Write `name.csv`, `name.json` and, where asked for, `name.parquet`.

    Numbers are written to the last bit. In the CSV the unit stands in the column's head; the JSON is a list
    of rows under `rows`, with `units` beside it.

    Raises
    ------
    UsageError
        For a format that is not known, or Parquet without its package.
    """
    check_formats(formats)
    written = []
    if "csv" in formats:
        heads = {
            str(column): f"{column} [{units[str(column)]}]" for column in table if units.get(str(column), "")
        }
        written.append(folder / f"{name}.csv")
        write_whole(written[-1], table.rename(columns=heads).to_csv(index=False, lineterminator="\n"))
    if "json" in formats:
        data = {"units": dict(units), "rows": records(table)}
        text = json.dumps(data, ensure_ascii=False, indent=1, allow_nan=False)
        written.append(folder / f"{name}.json")
        write_whole(written[-1], text + "\n")
    if "parquet" in formats:
        written.append(folder / f"{name}.parquet")
        _write_parquet(table, written[-1])
    return written


def records(table: pd.DataFrame) -> list[dict[str, Any]]:
    """Return the rows of a table by their columns' names; what is NaN there is None."""
    return [
        {str(name): None if value != value else value for name, value in row.items()}  # noqa: PLR0124  # NaN
        for row in table.astype(object).to_dict(orient="records")
    ]


def _write_parquet(table: pd.DataFrame, path: Path) -> None:
    buffer = io.BytesIO()
    table.to_parquet(buffer, index=False)
    write_whole(path, buffer.getvalue())
