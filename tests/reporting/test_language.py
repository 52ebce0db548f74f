"""Reasons are codes until they are read; each language has words for all of them, and no id covers words."""

from __future__ import annotations

import ast
import re
import string
import subprocess
from importlib.metadata import version
from pathlib import Path

import pytest
import yaml
from typer.testing import CliRunner

from certkit._version import __version__
from certkit.bench.pdf_attachments import attachments_of
from certkit.bench.render_documents import render
from certkit.bench.verify import verify
from certkit.cli.commands import whole_app
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.documents.wording import without_words
from certkit.errors import MissingPartError, UsageError
from certkit.reasons import Reason
from certkit.reporting import font_check, language_list
from certkit.reporting import language as language_module
from certkit.reporting.campaign_view import BASES, MEANINGS
from certkit.reporting.language import language, worded
from certkit.reporting.language_list import languages
from certkit.reporting.number_format import CONFIDENCE
from certkit.reporting.result_view import KINDS
from certkit.reporting.translated_titles import title_in
from tests.support.sheets import bump, corridor_set, grade, procedure, recording

PACKAGE = Path(__file__).parents[2] / "certkit"
MADE_FROM_PARTS = {
    "rests-on-recalled",
    "rests-on-secondary",
    "rests-on-derived",
    "rests-on-calibrated",
    "rests-on-estimated",
    "condition-not-recorded",
    "condition-not-recorded-not-required",
    "condition-not-finite",
    "condition-not-finite-not-required",
    "agreement-rating",
    "agreement-mean-rating",
    "agreement-criterion",
    "agreement-peak",
    "curve-early",
    "curve-late",
    "curve-early-or-more",
    "curve-late-or-more",
    "simple-acceptance",
    "guard-band",
    "model-not-legform",
    "simulated-by-others",
    "no-calibration-certificate",
    "energy-balance",
    "joint-gap",
    "penetration",
    "step-change",
    "group-travel",
    "group-room",
    "spring-range",
    "flesh-depth",
    "sensor-expired",
    "sensor-calibrated-later",
    "equipment-expired",
    "equipment-calibrated-later",
    "point-rests-on-finite-elements",
    "point-rests-on-lumped",
    "point-rests-on-prediction",
    "other-side-stands",
    "neighbour-stands",
}
"""Codes that do not stand as a word in `Reason.of("…")`, but in a table or a choice."""


def made() -> dict[str, set[str]]:
    """Return the codes that the program makes with a literal word, and the parameters of each."""
    found: dict[str, set[str]] = {}
    for path in PACKAGE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if (
                isinstance(node, ast.Call)
                and ast.unparse(node.func) == "Reason.of"
                and isinstance(node.args[0], ast.Constant)
            ):
                found.setdefault(str(node.args[0].value), set()).update(k.arg for k in node.keywords if k.arg)
    return found


def fields(template: str) -> set[str]:
    return {name for _, name, _, _ in string.Formatter().parse(template) if name}


def failing():
    sheet = procedure({"id": "T1", "corridor": "set/T1", "filter": "CFC 180"}, {"id": "T2"}, {"id": "T3"})
    corridors = corridor_set(windows={"T1": {"lower": "235 N·m", "upper": "272 N·m"}})
    return grade(sheet, corridors, recording({"T1": bump(200.0), "T2": bump(10.0)}), notes=["as it is"])


def test_every_reason_that_is_made_has_an_english_sentence_of_its_parameters():
    english = language().reasons
    assert {code for code in made() if code not in english} == set()
    wrong = {code: names for code, names in made().items() if not fields(english[code]) <= names}
    assert wrong == {}


def test_no_sentence_stands_there_for_nothing():
    assert set(language().reasons) - set(made()) == MADE_FROM_PARTS - set(made())


def complete_languages() -> list[str]:
    """Return the languages whose files say that they lack no word; any other may be begun with a few."""
    files = {code: (language_list.FOLDER / f"{code}.yaml").read_text("utf-8") for code in languages()}
    return [code for code, text in files.items() if yaml.safe_load(text).get("complete") is True]


def test_the_languages_that_reports_are_promised_in_are_complete():
    assert {"en", "de", "ja"} <= set(complete_languages())


@pytest.mark.parametrize("code", complete_languages())
def test_a_complete_language_has_every_verdict_and_every_reason(code: str):
    english, spoken = language(), language(code)
    for kind in ("verdicts", "reasons", "verification"):
        assert set(getattr(english, kind)) - set(getattr(spoken, kind)) == set()


@pytest.mark.parametrize("code", languages())
def test_a_language_has_no_sentence_and_no_parameter_that_english_lacks(code: str):
    english, spoken = language(), language(code)
    assert set(spoken.verdicts) <= set(english.verdicts)
    for kind in ("reasons", "verification"):
        own, theirs = getattr(spoken, kind), getattr(english, kind)
        assert set(own) <= set(theirs)
        for name, template in own.items():
            assert fields(template) <= fields(theirs[name]), name


TOY = """
name: Toy
verdicts: {pass: réussi, off: "no"}
reasons:
  no-corridor: aucun couloir n'est connu
"""


def test_a_language_is_one_file_and_what_it_lacks_is_english(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    (tmp_path / "en.yaml").write_bytes((language_list.FOLDER / "en.yaml").read_bytes())
    (tmp_path / "zz.yaml").write_text(TOY, "utf-8")
    for module in (language_list, language_module):
        monkeypatch.setattr(module, "FOLDER", tmp_path)
    language.cache_clear()
    assert languages() == ["en", "zz"]
    spoken = language("zz")
    assert (spoken.verdict("pass"), spoken.verdict("off"), spoken.verdict("fail")) == ("réussi", "no", "fail")
    assert spoken.sentence(Reason.of("no-corridor")) == "aucun couloir n'est connu"
    assert spoken.sentence(Reason.of("value-not-finite")) == "the value is not a number"
    language.cache_clear()


@pytest.mark.parametrize("path", sorted(language_list.FOLDER.glob("*.yaml")), ids=lambda path: path.stem)
def test_a_language_says_nothing_twice(path: Path):
    """A key that stands twice would lose its first words in silence."""
    assert read_tree(path.read_text("utf-8"), path.name).problems == []


@pytest.mark.parametrize("code", languages())
def test_an_id_does_not_depend_on_the_language(code: str):
    result = failing()
    assert worded(result, code).content_id() == result.id == result.with_id().id


def test_words_are_those_of_the_codes_and_are_taken_away_again():
    result = failing()
    assert result.remarks == [reason.text for reason in result.coded_remarks]
    assert all(result.remarks)
    assert "as it is" in result.notes
    bare = without_words(result)
    assert (bare.remarks, bare.notes) == ([], [])
    assert worded(bare) == result


def test_an_id_covers_the_code_and_its_parameters():
    result = failing()
    changed = [*result.coded_remarks[:-1], Reason.of("no-criterion-graded")]
    assert result.model_copy(update={"coded_remarks": changed}).content_id() != result.id


def test_an_id_covers_words_without_a_code():
    """As an earlier certkit wrote them: nobody may change them either."""
    result = failing()
    plain = result.model_copy(update={"coded_remarks": [], "remarks": ["Passed with honours."]})
    other = plain.model_copy(update={"remarks": ["Failed."]})
    assert plain.content_id() != other.content_id()


def test_a_reason_of_another_certkit_keeps_the_words_it_came_with():
    assert language().sentence(Reason(code="of-tomorrow", text="Said tomorrow.")) == "Said tomorrow."
    assert language().sentence(Reason(code="condition-outside", text="Outside.")) == "Outside."


def test_a_users_own_words_are_told_as_they_are():
    assert language().sentence(Reason.words("bleibt {so}")) == "bleibt {so}"


def test_an_unknown_language_is_refused_with_those_there_are():
    with pytest.raises(UsageError, match=re.escape(", ".join(languages()))):
        language("xx")


CALLS = {"t", "say", "word", "words_of", "spoken.word", "self.t", "view.t", "words.word", "language.word"}
"""How the code asks for a fixed word."""


def asked_words() -> set[str]:
    """Return the texts that the code asks the words of a language for."""
    found = set()
    for path in (*(PACKAGE / "reporting").rglob("*.py"), PACKAGE / "cli" / "verify_command.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Call) and node.args:
                called = ast.unparse(node.func)
                if called in CALLS or called.endswith(".word"):
                    texts = ast.walk(node.args[0])
                    found |= {each.value for each in texts if isinstance(each, ast.Constant)}
    return {text for text in found if isinstance(text, str)}


def fixed_words() -> set[str]:
    """Return the fixed words of templates and code: what stands in `t("…")`, and the tables of words.

    Names of measures and designs are not among them: a new one is English where a language lacks it.
    """
    texts = [path.read_text("utf-8") for path in (PACKAGE.parent / "templates").rglob("*.j2")]
    found = {word for text in texts for word in re.findall(r'\bt\(\s*"([^"]+)"', text)}
    kinds = {word for pair in KINDS.values() for word in pair}
    tables = (CONFIDENCE, CONFIDENCE.values(), MEANINGS.values(), BASES.values())
    return found | asked_words() | kinds | {word for table in tables for word in table}


@pytest.mark.parametrize("code", [code for code in complete_languages() if code != "en"])
def test_a_complete_language_has_every_fixed_word(code: str):
    assert fixed_words() - set(language(code).words) == set()


@pytest.mark.parametrize("code", languages())
def test_a_fixed_word_has_the_places_of_the_english_one(code: str):
    words = language(code).words
    assert {english for english, own in words.items() if fields(own) != fields(english)} == set()


def made_here():
    """Return a result of this version and its libraries, whose reports are rendered again by `verify`."""
    packages = {"weasyprint": version("weasyprint")}
    result = failing()
    provenance = result.provenance.model_copy(update={"certkit": __version__, "packages": packages})
    return result.model_copy(update={"provenance": provenance}).with_id()


@pytest.mark.parametrize("code", languages())
def test_a_report_in_any_language_is_verified(code: str, tmp_path: Path):
    result = made_here()
    written = render(result, tmp_path, "html", language=code)
    text = written[1].read_text("utf-8")
    assert f'<html lang="{code}">' in text
    assert result.id in text
    assert language(code).verdict("fail") in text
    checks = {check.what: check.holds for check in verify(tmp_path).checks}
    assert checks["report.html"]
    assert checks["result.json: words"]


@pytest.mark.parametrize(("code", "said"), [("de", "gilt nicht"), ("ja", "無効")])
def test_verify_tells_what_it_found_in_the_language(code: str, said: str, tmp_path: Path):
    render(made_here(), tmp_path, "html", language=code)
    done = CliRunner().invoke(whole_app(), ["verify", str(tmp_path), "--quick", "--language", code])
    assert said in done.stdout
    assert language(code).verdict("fail") in done.stdout
    assert done.stdout.splitlines()[-1] == language(code).verification["limits"]


@pytest.mark.parametrize("code", ["en", "de"])
def test_a_pdf_says_its_language_and_is_verified(code: str, tmp_path: Path):
    """Japanese as well where a font for it is installed; what happens where none is, stands below."""
    render(made_here(), tmp_path, "pdf", language=code)
    checks = {check.what: check.holds for check in verify(tmp_path / "report.pdf").checks}
    assert checks["pages"]
    assert attachments_of(tmp_path / "report.pdf").language == code


def test_without_a_font_there_is_no_pdf_of_empty_boxes(monkeypatch: pytest.MonkeyPatch):
    nothing = subprocess.CompletedProcess([], 0, stdout=b"")
    monkeypatch.setattr(font_check.shutil, "which", lambda _: "/usr/bin/fc-list")
    monkeypatch.setattr(font_check.subprocess, "run", lambda *_, **__: nothing)
    with pytest.raises(MissingPartError, match="fonts-noto-cjk"):
        font_check.check_font("ja")
    font_check.check_font("de")


@pytest.mark.parametrize("code", ["de", "ja"])
def test_titles_of_shipped_channels_parts_and_energies_are_said_in_the_language(code: str):
    spoken = language(code)
    for title in ("Tibia moment 1", "MCL elongation", "Knee bending angle", "joint spring stored", "tibia 3"):
        assert title_in(title, spoken) != title
    assert title_in("Tibia moment 4", spoken).endswith(" 4")
    assert title_in("MCL elongation", spoken).startswith("MCL ")
    assert title_in("a channel of one's own", spoken) == "a channel of one's own"
