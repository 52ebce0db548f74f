"""The pages that are made from the code say what the code does now."""

from __future__ import annotations

import pkgutil
from importlib import import_module
from pathlib import Path

import pytest

from certkit.definitions.loading.kinds import KINDS
from docs.make.reference import DOCS, PAGES, write_reference


@pytest.mark.parametrize("name", PAGES)
def test_a_reference_page_is_what_the_command_makes(name: str) -> None:
    made = PAGES[name]()
    assert (DOCS / name).read_text() == made, f"run `python -m docs.make reference` and commit docs/{name}"


def test_the_command_writes_the_same_pages_elsewhere(tmp_path: Path) -> None:
    assert {path.name for path in write_reference(tmp_path)} == set(PAGES)
    assert all((tmp_path / name).read_bytes() == (DOCS / name).read_bytes() for name in PAGES)


def test_what_makes_pages_that_no_test_makes_finds_all_that_it_uses() -> None:
    for module in pkgutil.walk_packages([str(DOCS / "make")], "docs.make."):
        if not module.name.endswith("__main__"):
            import_module(module.name)


def test_every_kind_of_definition_has_its_section() -> None:
    text = (DOCS / "definitions.md").read_text()
    assert [word for word in KINDS if f"\n## {word} " not in text] == []
