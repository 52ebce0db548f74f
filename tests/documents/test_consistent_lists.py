"""A document whose lists do not fit together is refused where it is read; so is a name that leads away."""

from __future__ import annotations

import json
from typing import Any

import pytest
from support import synthetic_result

from certkit.documents.consistent_lists import MOST_SAMPLES
from certkit.documents.result import Result
from certkit.errors import DataError


def read(document: dict[str, Any]) -> Result:
    return Result.from_json(json.dumps(document), "sent.json")


@pytest.mark.parametrize(
    ("path", "value", "said"),
    [
        (("energies", "count"), 10**9, rf"energies: .*at most {MOST_SAMPLES} samples"),
        (("channels", "count"), 999, r"channels: .*1000 values for 999 samples"),
        (("curves", "interval"), 0.0, r"curves: .*goes forward"),
        (("curves", "interval"), -1e-4, r"curves: .*goes forward"),
        (("curves", "start"), 1e200, r"curves: .*`start`"),
        (("motion", "times"), [0.0], r"motion: .*`poses` has 81 values for 1 times"),
        (("motion", "joints"), [], r"motion: .*`moments.0` has 20 values for 0 joints"),
        (("motion", "shapes"), [], r"motion: .*`poses.0` has 20 values for 0 shapes"),
        (("procedure",), "../elsewhere", r"procedure: .*no plain name"),
        (("procedure",), "/etc/elsewhere", r"procedure: .*no plain name"),
    ],
)
def test_what_does_not_fit_together_is_refused_with_its_place(
    path: tuple[str, ...], value: object, said: str
):
    document = synthetic_result.document()
    read(document)
    inner: Any = document
    for step in path[:-1]:
        inner = inner[step]
    inner[path[-1]] = value
    with pytest.raises(DataError, match=said):
        read(document)


def test_a_value_that_no_chart_can_show_is_refused():
    document = synthetic_result.document()
    document["curves"]["series"]["T1"]["values"][7] = 1e300
    with pytest.raises(DataError, match=r"curves: .*`T1` has a value beyond"):
        read(document)
