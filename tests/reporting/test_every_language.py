"""No fixed English word remains on a page in another language.

The pages are rendered in a made-up language whose every word is the English one between brackets. What
stands outside of brackets then is either the document's own (names, ids, quoted words), or was forgotten.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path

import pytest
import yaml
from support import synthetic_campaign, synthetic_extraction, synthetic_result
from support.worn_leg import worn

import certkit
from certkit.documents.comparison import (
    AgreementCheck,
    ChannelRating,
    ComparisonDocument,
    Overlay,
    Side,
)
from certkit.documents.logbook_overview import LegOverview
from certkit.documents.output_document import OutputDocument
from certkit.documents.result import ComparisonRow, Result
from certkit.logbooks import Issue, Logbook, add, certificate_of, certification, overview
from certkit.reasons import Reason
from certkit.reporting import language as language_module
from certkit.reporting import language_list
from certkit.reporting.document_reports import render_document
from certkit.reporting.language import language, worded
from certkit.reporting.language_list import languages
from certkit.reporting.templating import _environment, folder
from certkit.reporting.translated_titles import title_in
from certkit.reporting.works_cited import bibliography
from tests.documents.test_any_document import DOCUMENTED

NEUTRAL = {
    *("certkit", "ISO", "TS", "SHA", "FE", "Grubbs", "CV", "UN", "CFC", "ms", "mm", "deg", "kN", "verify"),
    *("rms", "json", "result", "dev", "Morris", "Sobol", "Monte", "Carlo", "certificate"),
}
"""Names, units and file names, which no language translates."""


def bracketed(table: dict[str, str]) -> dict[str, str]:
    return {key: f"⟦{text}⟧" for key, text in table.items()}


@pytest.fixture
def brackets(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[str]:
    """Let there be a language `xx` that says everything in English between brackets."""
    folder = tmp_path / "languages"
    folder.mkdir()
    english, german = (
        yaml.safe_load((language_list.FOLDER / f"{code}.yaml").read_text("utf-8")) for code in ("en", "de")
    )
    held = {
        "name": "brackets",
        "verdicts": bracketed(english["verdicts"]),
        "words": {word: f"⟦{word}⟧" for word in german["words"]},
        "reasons": bracketed(english["reasons"]),
    }
    (folder / "xx.yaml").write_text(yaml.safe_dump(held, allow_unicode=True), "utf-8")
    (folder / "en.yaml").write_bytes((language_list.FOLDER / "en.yaml").read_bytes())
    for module in (language_list, language_module):
        monkeypatch.setattr(module, "FOLDER", folder)
    language.cache_clear()
    yield "xx"
    language.cache_clear()
    _environment.cache_clear()


READ = {"aria-label", "alt", "title", "data-dark", "data-light", "data-to-dark", "data-to-light"} | {
    *("data-keys", "data-words", "data-pause", "data-unit", "data-slow"),
}
"""Attributes that are read aloud, or shown by the page's scripts."""


class Said(HTMLParser):
    """What a page says to its reader: texts, and the attributes that are read aloud or shown."""

    def __init__(self) -> None:
        super().__init__()
        self.texts: list[str] = []
        self.skipping = 0

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.skipping += tag in {"style", "script"}
        self.texts += [value for name, value in attrs if value and name in READ]

    def handle_endtag(self, tag: str) -> None:
        self.skipping -= tag in {"style", "script"}

    def handle_data(self, data: str) -> None:
        if not self.skipping:
            self.texts.append(data)


def outside_brackets(text: str) -> str:
    """Return a text without what stands in brackets, however deep they are."""
    while True:
        shorter = re.sub(r"⟦[^⟦⟧]*⟧", " ", text)
        if shorter == text:
            return text
        text = shorter


TRANSLATED = {
    *("kind", "verdict", "state", "basis", "grade", "confidence", "distribution", "design", "answer", "role"),
    *("cochran", "grubbs", "schema", "code"),
}
"""Fields of documents whose words are not shown as they are."""


KEYED = {"specimen", "sources", "counts", "packages", "changes", "series", "laboratory"}
"""Fields whose keys are shown: names that the document gives."""


def own_texts(value: object, name: str = "") -> Iterator[str]:
    """Return a document's own texts: names, ids, quoted words."""
    if isinstance(value, dict):
        for key, each in value.items():
            of_code = value.get("coded_" + key) or (key == "text" and name != "parameters")
            if name in KEYED:
                yield key
            if key not in TRANSLATED and not of_code:
                yield from own_texts(each, "laboratory" if name == "laboratory" else key)
    elif isinstance(value, list):
        for each in value:
            yield from own_texts(each, name)
    elif isinstance(value, str) and (name == "id" or title_in(value, language("xx")) == value):
        yield value


def words_of(text: str) -> set[str]:
    return set(re.findall(r"[^\W\d_]{2,}", text))


def forgotten(page: str, document: OutputDocument) -> list[str]:
    """Return the texts of a page that hold words which are neither bracketed nor the document's."""
    reader = Said()
    reader.feed(page)
    own = words_of(" ".join(own_texts(json.loads(document.to_json())))) | words_of(str(bibliography()))
    return [text.strip() for text in reader.texts if words_of(outside_brackets(text)) - own - NEUTRAL]


def leg_with_tests(folder: Path) -> tuple[LegOverview, list[Result]]:
    """Return a legform's logbook with tests that drift, and the results of the last ones."""
    results = worn(synthetic_result.laboratory_result())
    for place, result in enumerate(results):
        result.write(folder / f"{place}.json")
    book = Logbook(folder / "book")
    add(book, sorted(folder.glob("*.json")))
    leg = overview(book, book.serials()[0], curves=True)
    return leg, list(
        book.results(line.id for line in certification.tests_to_certify(leg).values() if line is not None)
    )


COMPARED = ComparisonDocument(
    title="b compared with a",
    reference=Side(label="a", kind="measured", title="Dynamic certification, pendulum test", verdict="pass"),
    other=Side(label="b", kind="simulated"),
    rows=[ComparisonRow(channel="T1", test=250.0, simulation=255.0, error_percent=2.0)],
    rms_error_percent=2.0,
    interval=(0.0, 0.1),
    rating=0.9,
    grade="good",
    ratings=[
        ChannelRating(
            channel="T1",
            title="tibia moment 1",
            overall=0.9,
            grade="good",
            coded_causes=[Reason.of("curve-late", by=2.0)],
        ),
        ChannelRating(channel="T2", title="tibia moment 2", coded_reason=Reason.of("rated-constant")),
    ],
    overlays=[
        Overlay(
            channel="T1",
            title="tibia moment 1",
            unit="N·m",
            filter="CFC 180",
            start=0.0,
            interval=1e-3,
            reference=[0.0, 1.0, 0.0],
            other=[0.0, 2.0, 0.0],
            difference=[0.0, 1.0, 0.0],
        )
    ],
    rule="ours",
    checks=[
        AgreementCheck(
            kind="rating",
            coded_title=Reason.of("agreement-mean-rating"),
            value=0.9,
            lower=0.8,
            verdict="pass",
        )
    ],
    verdict="pass",
    coded_notes=[Reason.of("values-of-criteria")],
)


@pytest.mark.parametrize(
    "word",
    [
        *("result", "comparison", "campaign-report", "study-report", "optimum-report", "calibration-report"),
        *(
            "uncertainty-report",
            "twin",
            "round-robin",
            "logbook-overview",
            "legform-certificate",
            "extraction",
        ),
    ],
)
def test_no_english_word_remains(word: str, brackets: str, tmp_path: Path):
    if word in {"logbook-overview", "legform-certificate"}:
        leg, results = leg_with_tests(tmp_path)
        document = leg if word == "logbook-overview" else certificate_of(leg, results, Issue()).with_id()
    else:
        document = {
            "comparison": COMPARED.with_id(),
            "result": synthetic_result.laboratory_result(),
            "extraction": synthetic_extraction.extraction(),
        }.get(word, DOCUMENTED[word])
    document = worded(document).as_written()
    (page,) = render_document(document, tmp_path / "page", ["html"], spoken=brackets)
    text = page.read_text("utf-8")
    assert '<html lang="xx">' in text
    assert document.id in text or word == "logbook-overview"
    assert forgotten(text, document) == []


def test_no_english_word_remains_of_a_front_and_a_rig(brackets: str, tmp_path: Path):
    for name in ("vehicle", "pendulum", "inverse", "static-knee"):
        document = worded(certkit.run(name, refine=False)).as_written()
        (page,) = render_document(document, tmp_path / name, ["html"], spoken=brackets)
        assert forgotten(page.read_text("utf-8"), document) == []


def test_scripts_have_no_words_of_their_own():
    scripts = sorted((folder() / "scripts").glob("*.js"))
    assert scripts
    for script in scripts:
        shown = re.findall(r"textContent = (.*);|\"aria-\w+\", (.*)\);", script.read_text("utf-8"))
        assert shown
        for line in shown:
            literals = " ".join(re.findall(r"[\"`][^\"`]*[\"`]", "".join(line)))
            said = re.sub(r"\{[^}]*\}|\[[^]]*\]|aria-\w+", "", literals)  # placeholders and selectors
            assert words_of(said) <= NEUTRAL, script.name


@pytest.mark.parametrize("code", languages())
def test_a_document_has_one_id_in_each_language(code: str, tmp_path: Path):
    document = worded(synthetic_campaign.campaign()).with_id()
    assert worded(document, code).content_id() == document.id
    (page,) = render_document(document, tmp_path, ["html"], spoken=code)
    assert document.id in page.read_text("utf-8")
