"""Binout files of one run are read as one, whichever way the solver spread it over them."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.errors import DataError
from certkit.exchange.fe.joined_binout import JoinedBinout

TIME = np.linspace(0.0, 0.01, 11)
FORCE = np.outer(TIME, [1.0, 2.0, 3.0])


class Opened:
    """One file as lasso opens it."""

    def __init__(self, **tables: dict[str, object]) -> None:
        self.tables = tables

    def read(self, *names: str) -> object:
        if not names:
            return list(self.tables)
        table = self.tables[names[0]]
        return list(table) if len(names) == 1 else table[names[1]]


def contacts(rows: slice = slice(None), columns: tuple[int, ...] = (0, 1, 2)) -> dict[str, object]:
    legend = "".join(f"contact {k + 1}".ljust(80) for k in columns)
    return {
        "time": TIME[rows],
        "ids": np.array(columns) + 1,
        "legend": legend,
        "legend_ids": np.array(columns) + 1,
        "x_force": FORCE[rows][:, columns],
    }


def test_tables_that_processors_wrote_into_files_of_their_own_are_all_there() -> None:
    joined = JoinedBinout([Opened(matsum={"time": TIME}), Opened(rcforc=contacts())], "run")
    assert joined.read() == ["matsum", "rcforc"]
    assert np.array_equal(joined.read("rcforc", "x_force"), FORCE)


def test_a_run_that_was_started_again_goes_on_where_it_was() -> None:
    files = [Opened(rcforc=contacts(slice(5, None))), Opened(rcforc=contacts(slice(0, 8)))]
    joined = JoinedBinout(files, "run")
    assert np.array_equal(joined.read("rcforc", "time"), TIME)
    assert np.array_equal(joined.read("rcforc", "x_force"), FORCE)
    assert joined.read("rcforc", "legend").count("contact") == 3


def test_objects_of_one_table_in_several_files_stand_side_by_side() -> None:
    files = [Opened(rcforc=contacts(columns=(0, 2))), Opened(rcforc=contacts(columns=(1,)))]
    joined = JoinedBinout(files, "run")
    assert joined.read("rcforc", "ids").tolist() == [1, 3, 2]
    assert np.array_equal(joined.read("rcforc", "x_force"), FORCE[:, [0, 2, 1]])
    assert joined.read("rcforc", "legend").count("contact") == 3


def test_objects_at_other_instants_are_refused() -> None:
    files = [
        Opened(rcforc=contacts(columns=(0,))),
        Opened(rcforc=contacts(slice(0, 5), columns=(1,))),
    ]
    with pytest.raises(DataError, match="other instants"):
        JoinedBinout(files, "run").read("rcforc", "x_force")
