"""Every source of a shipped number points into the bibliography, and reports print what it points to."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import support.synthetic_result as made_up
import yaml

from certkit.definitions.bibliography import OWN
from certkit.reporting.result_view import view
from certkit.reporting.works_cited import bibliography, works_cited

ROOT = Path(__file__).parents[2]
FOLDERS = ("corridors", "procedures", "models", "references", "schemes", "agreement", "certkit/logbooks")
FILES = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.yaml"))]


def origins(found: Any) -> Iterator[tuple[str, str | None]]:  # noqa: ANN401  # whatever stands in YAML
    """Yield every source with its confidence, where that stands beside it."""
    if isinstance(found, dict):
        if isinstance(found.get("source"), str):
            yield found["source"], found.get("confidence")
        found = list(found.values())
    for item in found if isinstance(found, list) else ():
        yield from origins(item)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_source_names_a_work_or_says_that_it_is_an_estimate_or_a_derivation(path: Path):
    lost = [
        source
        for source, confidence in origins(yaml.safe_load(path.read_text("utf-8")))
        if confidence not in OWN and not bibliography().cited(source)
    ]
    assert lost == []


def test_every_work_is_named_by_a_source():
    sources = [s for path in FILES for s, _ in origins(yaml.safe_load(path.read_text("utf-8")))]
    assert set(bibliography().cited_by(sources)) == set(bibliography().works)


def test_the_seed_paper_stands_there_in_full():
    (paper,) = bibliography().cited("seed paper, section 2.3.1").values()
    assert "Development of a Flex-PLI System Model and Investigations of Injury" in paper.entry
    assert "neither authors, nor year" in paper.read


def test_part_of_a_word_names_no_work():
    assert bibliography().cited("XUN R1270") == {}
    assert list(bibliography().cited("UN R127: 5.1.1, see also JNCAP")) == ["UN R127", "JNCAP"]


def test_a_source_in_plain_words_may_name_none():
    assert bibliography().cited("our own drop tower, report 12") == {}


def test_a_report_lists_each_work_once():
    result = made_up.static_result()
    criteria = [c.model_copy(update={"source": "UN R127, annex 6; JNCAP"}) for c in result.criteria]
    both = result.model_copy(update={"criteria": criteria, "parameters": []})
    assert list(works_cited(both)) == ["UN R127", "JNCAP"]
    assert view(both).works.keys() == works_cited(both).keys()
