"""The CSV that OpenRadioss' own converter writes from a native time history."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NoReturn

import numpy as np

from certkit.errors import DataError
from certkit.exchange.fe.checks import require_time_axis
from certkit.exchange.fe.histories import parse_units
from certkit.exchange.fe.numeric_table import NumericTable, read_table
from certkit.exchange.fe.one_file import one_file
from certkit.exchange.fe.radioss import part_histories
from certkit.exchange.fe.radioss_channels import Channels

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from certkit.definitions.extraction_case import HistoryFiles
    from certkit.definitions.virtual_test import FiniteElements
    from certkit.exchange.fe.histories import PartHistories

    Objects = dict[str, dict[str, NDArray[np.float64]]]

_ENERGIES = {
    "INTERNAL ENERGY": "internal",
    "KINETIC ENERGY": "kinetic",
    "ROTATION ENERGY": "rotation",
    "EXTERNAL WORK": "external work",
    "SPRING ENERGY": "spring",
    "CONTACT ENERGY": "contact",
    "HOURGLASS ENERGY": "hourglass",
}
_OTHER_GLOBALS = frozenset(
    {
        *("X-MOMENTUM", "Y-MOMENTUM", "Z-MOMENTUM", "MASS", "TIME STEP", "PLASTIC WORK"),
        *(
            "ADDED MASS",
            "PERCENTAGE ADDED MASS",
            "INLET MASS",
            "OUTLET MASS",
            "INLET ENERGY",
            "OUTLET ENERGY",
        ),
        *(f"{kind} CONTACT ENERGY" for kind in ("ELASTIC", "FRICTIONAL", "DAMPING")),
    }
)
_PART = re.compile(r"^(?P<name>.+) (?P<variable>IE|KE|[XYZ]MOM|MASS|HE|[XYZ]CG|V[XYZ]|ERODED|HEAT)$")
_OBJECT = re.compile(r"^(?P<group>.+?) (?P<id>\d+) (?P<name>.+) (?P<variable>[A-Z]{2,3})$")


_SHIFT = 6
"""Columns by which some versions of the converter move what stands behind the parts (OpenRadioss)."""


def _require_unshifted(table: NumericTable) -> None:
    objects = [values for head, values in table.columns.items() if _OBJECT.match(head)]
    if len(objects) > _SHIFT and not np.any(objects[:_SHIFT]) and np.any(objects[_SHIFT:]):
        raise DataError(
            f"{table.source}: the first {_SHIFT} columns behind the parts' are zero, as a converter "
            "leaves them that shifts by so many: convert with a newer one, or read the native file (…T01)"
        )


def holds(content: bytes) -> bool:
    """Tell a converted history by its first heads."""
    return re.match(rb'\s*"?time\s*"?,\s*"?INTERNAL ENERGY', content) is not None


def open_run(paths: Sequence[Path], _: FiniteElements) -> NoReturn:
    """Refuse a run: its columns cannot be told by the solver's names any more."""
    raise DataError(f"{paths[0]}: a converted CSV has lost part of its names; grade the native file (…T01)")


def read(paths: Sequence[Path], section: HistoryFiles) -> PartHistories:
    """Read the time history of a case."""
    channels = read_converted(one_file(paths, section))
    return part_histories(channels, parse_units(section.units), section.rigid_bodies)


def read_converted(path: Path) -> Channels:
    """Read a converted OpenRadioss time history (`.csv` or `.csv.gz`).

    Contact columns are told by their variables (`FNX`), nodes by theirs (`DX`).

    Raises
    ------
    DataError
        For a damaged table or one without time or parts.
    """
    table = read_table(path)
    if "time" not in table.columns:
        raise DataError(f"{path}: there is no column `time`; name OpenRadioss' converted CSV")
    time = table.columns["time"]
    require_time_axis(time, table.source)
    parts: Objects = {}
    contacts: Objects = {}
    nodes: Objects = {}
    energies = {}
    unread = []
    _require_unshifted(table)
    for head, values in table.columns.items():
        if head in _OTHER_GLOBALS:
            continue
        if head in _ENERGIES:
            energies[_ENERGIES[head]] = values
        elif found := _OBJECT.match(head):
            variable = found["variable"]
            owner = contacts if variable[:2] in {"FN", "FT"} else nodes if variable[0] in "DV" else None
            if owner is None:
                unread.append(head)
            else:
                owner.setdefault(found["name"], {})[variable] = values
        elif found := _PART.match(head):
            parts.setdefault(found["name"], {})[found["variable"]] = values
        elif head != "time":
            unread.append(head)
    if not parts:
        raise DataError(
            f"{path}: there are no part histories; add the parts to the solver's /TH/PART request"
        )
    return Channels(
        time, energies, parts, contacts, nodes,
        impulses=False, source=table.source, digest=table.digest, unread=tuple(unread),
    )  # fmt: skip
