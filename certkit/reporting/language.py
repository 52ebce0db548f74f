"""Words of a language: verdicts, the reports' fixed words, and a sentence for each code of a reason."""

from __future__ import annotations

import string
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any, TypeVar

from certkit.documents.wording import with_words
from certkit.errors import UsageError
from certkit.reasons import WORDS, Reason
from certkit.reporting.language_list import FOLDER, languages

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from pydantic import BaseModel

    Model = TypeVar("Model", bound=BaseModel)

ENGLISH = "en"


@dataclass(frozen=True)
class Language:
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
        (`A, B, C`), `and` (`A, B and C`), `join` (without anything between), `verdict` and `word`.
    """

    code: str
    name: str
    verdicts: Mapping[str, str]
    words: Mapping[str, str]
    reasons: Mapping[str, str]

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
        for template in (self.reasons.get(reason.code), language().reasons.get(reason.code)):
            if template is not None:
                try:
                    return _Sentence(self).vformat(template, (), reason.parameters)
                except (KeyError, ValueError, TypeError, IndexError, AttributeError):
                    continue  # parameters of another certkit
        return str(reason)


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
            if format_spec == "and" and len(texts) > 1:
                return self.spoken.word("{first} and {last}", first=", ".join(texts[:-1]), last=texts[-1])
            return ("" if format_spec == "join" else ", ").join(texts)
        return str(super().format_field(value, format_spec))


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
    module = import_module(f"{FOLDER}.{code}")
    return Language(code, module.NAME, module.VERDICTS, module.WORDS, module.REASONS)


def worded(document: Model, code: str = ENGLISH) -> Model:
    """Return a document with the reasons in it worded.

    A finished document has English words; reports in other languages are made of one worded anew. The id is
    the same: words are not counted.
    """
    return with_words(document, language(code).sentence)


def worded_reasons(reasons: Sequence[Reason], code: str = ENGLISH) -> list[Reason]:
    """Return reasons with their words, as files that leave certkit hold them."""
    return [reason.worded(language(code).sentence(reason)) for reason in reasons]
