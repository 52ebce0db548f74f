"""Words of a language: verdicts, fixed words of the pages, and a sentence for each code of a reason.

Each language is one file of `languages/`, data alone; see `en.yaml` there.
"""

from __future__ import annotations

import string
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any, TypeVar

from msgspec import Struct

from certkit.documents.wording import with_words
from certkit.errors import UsageError
from certkit.reasons import WORDS, Reason
from certkit.reporting import language_list
from certkit.reporting.language_list import FOLDER, languages
from certkit.reporting.number_format import MINUS

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from pydantic import BaseModel

    Model = TypeVar("Model", bound=BaseModel)

ENGLISH = language_list.ENGLISH

Translate = Callable[..., str]
"""A language's fixed word for an English one: `Language.word`."""


class Language(Struct, frozen=True):
    """A language.

    Parameters
    ----------
    code : str
        ISO 639-1: `en`, `de`, `ja`.
    name : str
        In itself: `Deutsch`.
    verdicts : mapping of str to str
        By the verdict of the document.
    words : mapping of str to str
        Fixed words by the English ones.
    reasons : mapping of str to str
        Sentence of each code, with its parameters in braces. Format specifications are Python's, and `list`
        (`A, B, C`), `and` (`A, B and C`), `each` (`A; B; C`), `join` (without anything between), `verdict`
        and `word`.
    verification : mapping of str to str
        Sentence of each code of a check of `certkit verify`, likewise.
    """

    code: str
    name: str
    verdicts: Mapping[str, str]
    words: Mapping[str, str]
    reasons: Mapping[str, str]
    verification: Mapping[str, str]

    def verdict(self, word: str) -> str:
        """Return a verdict's word, such as `bestanden`."""
        return self.verdicts.get(word, word)

    def word(self, english: str, /, **values: object) -> str:
        """Return a fixed word or phrase, with `values` in its braces."""
        found = self.words.get(english, english)
        return _Sentence(self).format(found, **values) if values else found

    def sentence(self, reason: Reason) -> str:
        """Return the words of a reason; of a code that nobody knows, the words that it came with."""
        if reason.code == WORDS:
            return str(reason.parameters.get("text", ""))
        templates = (self.reasons.get(reason.code), language().reasons.get(reason.code))
        return self._filled(templates, reason.parameters) or str(reason)

    def verified(self, code: str, parameters: Mapping[str, Any]) -> str:
        """Return what a check of `certkit verify` found, by its code."""
        templates = (self.verification.get(code), language().verification.get(code))
        return self._filled(templates, parameters) or code

    def _filled(self, templates: Sequence[str | None], parameters: Mapping[str, Any]) -> str:
        """Fill in the first of the templates that the parameters suit; those of another certkit may not."""
        for template in templates:
            if template is not None:
                try:
                    return _Sentence(self).vformat(template, (), parameters)
                except (KeyError, ValueError, TypeError, IndexError, AttributeError):
                    continue
        return ""


class _Sentence(string.Formatter):
    """Formats a sentence's parameters in a language."""

    def __init__(self, spoken: Language) -> None:
        """Keep the language."""
        self.spoken = spoken

    def format_field(self, value: Any, format_spec: str) -> str:  # noqa: ANN401  # any parameter
        """Format one parameter; reasons within it are worded first."""
        if format_spec == "verdict":
            return self.spoken.verdict(str(value))
        if format_spec == "word":
            return self.spoken.word(str(value))
        if isinstance(value, list):
            texts = [self.spoken.sentence(v) if isinstance(v, Reason) else str(v) for v in value]
            comma = self.spoken.word(", ")
            if format_spec == "and" and len(texts) > 1:
                return self.spoken.word("{first} and {last}", first=comma.join(texts[:-1]), last=texts[-1])
            return {"join": "", "each": "; "}.get(format_spec, comma).join(texts)
        text = str(super().format_field(value, format_spec))
        return _number_text(text) if isinstance(value, int | float) else text


def _number_text(text: str) -> str:
    """Return a number's text with a true minus, no sign of a zero, and no point behind the last digit."""
    text = text.removesuffix(".")
    if text.strip("+-0.%") == "":
        return text.lstrip("+-")
    return MINUS + text[1:] if text.startswith("-") else text


@cache
def language(code: str = ENGLISH) -> Language:
    """Return a language.

    Raises
    ------
    UsageError
        When there is no such language.
    """
    if code not in languages():
        raise UsageError(f"there is no language `{code[:20]}`; there are {', '.join(languages())}")
    import yaml  # noqa: PLC0415  # whoever only asks which languages there are needs none

    # Every value is a text, also `off`; libyaml reads it in 2 ms, PyYAML's own parser in 20.
    loader: Any = getattr(yaml, "CBaseLoader", yaml.BaseLoader)
    held = yaml.load((FOLDER / f"{code}.yaml").read_text("utf-8"), loader)  # noqa: S506  # makes texts alone
    tables = (held.get(name) or {} for name in ("verdicts", "words", "reasons", "verification"))
    return Language(code, held["name"], *tables)


def english(text: str, /, **values: object) -> str:
    """Return a fixed word in English, with `values` in its braces; see `Language.word`."""
    return language().word(text, **values)


def worded(document: Model, code: str = ENGLISH) -> Model:
    """Return a document with the reasons in it worded.

    A finished document has English words; reports in other languages are made of one worded anew. The id is
    the same: words are not counted.
    """
    return with_words(document, language(code).sentence)


def worded_reasons(reasons: Sequence[Reason]) -> list[Reason]:
    """Return reasons with their English words, as files that leave certkit hold them."""
    return [reason.worded(language().sentence(reason)) for reason in reasons]
