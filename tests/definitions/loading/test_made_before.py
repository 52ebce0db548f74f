"""A changed definition is the same whether all of it is read again or only what has changed."""

from __future__ import annotations

import pytest

from certkit.definitions.base import Document
from certkit.definitions.loading.kinds import KINDS
from certkit.definitions.loading.library import find, load, names
from certkit.definitions.loading.made_before import with_made
from certkit.definitions.loading.old_forms import modernised
from certkit.definitions.loading.overrides import change
from certkit.definitions.loading.parameter_list import parameters
from certkit.definitions.loading.validation import validate
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.definitions.units import dimensions, split_quantity
from certkit.errors import DefinitionError

SHIPPED = [(kind, name) for kind in ("procedure", "legform", "vehicle") for name in names(kind)]


def read_whole(kind: str, name: str, overrides: dict[str, str]) -> object:
    found = find(KINDS[kind], name)
    tree, overrides_now, _ = modernised(KINDS[kind], read_tree(found.data, found.file), overrides)
    return validate(change(tree, overrides_now, KINDS[kind].model)[0], KINDS[kind].model)


@pytest.mark.parametrize(("kind", "name"), SHIPPED, ids=str)
def test_what_is_taken_over_is_what_would_be_read(kind: str, name: str) -> None:
    first = load(kind, name).document
    assert isinstance(first, Document)
    numbers = [entry for entry in parameters(first) if dimensions(entry.value)]
    for entry in numbers[:: max(1, len(numbers) // 12)]:
        number, unit = split_quantity(entry.value) or (0.0, "")
        overrides = {entry.path: f"{number * 1.0001!r} {unit}".rstrip()}
        made = load(kind, name, overrides=overrides).document
        assert made == read_whole(kind, name, overrides), entry.path


@pytest.mark.parametrize("path", ["method.edition", "method.confidence", "method.document"])
def test_numbers_under_a_changed_text_have_its_origin(path: str) -> None:
    overrides = {path: "estimated" if path.endswith("confidence") else "another text", "run.until": "0.1 s"}
    load("procedure", "pendulum")
    made = load("procedure", "pendulum", overrides=overrides).document
    assert made == read_whole("procedure", "pendulum", overrides)


def test_unchanged_sections_are_the_very_same_objects() -> None:
    kind = KINDS["legform"]
    first = load("legform", "flex-pli-gtr").document
    second = load("legform", "flex-pli-gtr", overrides={"parts.femur.mass": "3 kg"}).document
    assert second.knee is first.knee
    assert second.parts["tibia"] is first.parts["tibia"]
    assert second.parts["femur"] is not first.parts["femur"]
    found = find(kind, "flex-pli-gtr")
    assert with_made("legform", found, read_tree(found.data, found.file).data) is first


def test_a_wrong_change_is_told_as_if_all_were_read() -> None:
    load("legform", "flex-pli-gtr")
    wrong = {"parts.femur.mass": "-3 kg", "channels.T1.from knee centre": "3 m"}
    with pytest.raises(DefinitionError) as found:
        load("legform", "flex-pli-gtr", overrides=wrong)
    with pytest.raises(DefinitionError) as whole:
        read_whole("legform", "flex-pli-gtr", wrong)
    assert str(found.value) == str(whole.value)
