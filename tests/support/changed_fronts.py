"""The shipped finite-element front with its run told otherwise: higher above the ground, or later."""

from __future__ import annotations

import csv
import gzip
import io
import json
import re
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

FRONT = Path(__file__).parents[2] / "examples/extract/front1"
HISTORIES = ("vehicle_groups", "contact_forces", "ground_forces", "leg_channels")
Rows = list[dict[str, str]]


def copied(folder: Path) -> Path:
    """Copy the case into a folder, unpacked, and return it."""
    for path in FRONT.iterdir():
        if path.suffix == ".gz":
            (folder / path.stem).write_bytes(gzip.decompress(path.read_bytes()))
        elif path.suffix in {".yaml", ".csv", ".json"}:
            shutil.copy(path, folder)
    return folder / "case.yaml"


def change(path: Path, of_rows: Callable[[Rows], Rows], also: Sequence[str] = ()) -> None:
    """Change the rows of a table; `also` are columns that they gain."""
    reader = csv.DictReader(io.StringIO(path.read_text()))
    rows = of_rows(list(reader))
    out = io.StringIO()
    writer = csv.DictWriter(out, [*(reader.fieldnames or []), *also], lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    path.write_text(out.getvalue())


def turn_columns(path: Path, columns: str, by: Callable[[float], float]) -> None:
    """Change every number of the columns whose names match a pattern."""

    def turned(rows: Rows) -> Rows:
        chosen = {c for c in rows[0] if re.fullmatch(columns, c)}
        return [{c: f"{by(float(v)):.9g}" if c in chosen and v else v for c, v in r.items()} for r in rows]

    change(path, turned)


def raised(folder: Path, by: float) -> None:
    """Lift the car and its leg by a height, mm."""

    def lifted(rows: Rows, *columns: str) -> Rows:
        return [{**r, **{c: f"{float(r[c]) + by:.6g}" for c in columns if r[c]}} for r in rows]

    change(folder / "animation_1ms.csv", lambda rows: lifted(rows, "z_mm"))
    change(folder / "groups_table.csv", lambda rows: lifted(rows, "cg_z0_mm", "z_low_mm", "z_high_mm"))
    outlines = json.loads((folder / "params.json").read_text())
    for key, line in outlines.items():
        if key.endswith("_poly_x_z"):
            outlines[key] = [[x, z + by] for x, z in line]
    (folder / "params.json").write_text(json.dumps(outlines))


def later(folder: Path, by: float) -> None:
    """Let the clock of all histories begin earlier, so that everything comes later, ms."""
    for name in (*HISTORIES, "animation_1ms"):
        change(
            folder / f"{name}.csv",
            lambda rows: [{**row, "time_ms": f"{float(row['time_ms']) + by:.9g}"} for row in rows],
        )
