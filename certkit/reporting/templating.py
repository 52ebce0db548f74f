"""The templates: where they are, and a sandbox in which data can be shown but not run."""

from __future__ import annotations

import re
import unicodedata
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from certkit.errors import UsageError
from certkit.reporting import number_format as words
from certkit.reporting.charts.number_rows import number_rows
from certkit.reporting.language import ENGLISH, language
from certkit.reporting.translated_titles import title_in

if TYPE_CHECKING:
    from jinja2.sandbox import SandboxedEnvironment

_PACKAGE = Path(__file__).resolve().parent.parent


@cache
def folder() -> Path:
    """Return the folder with templates, styles, scripts and fonts.

    It travels inside the wheel and stands at the top of a checkout.

    Raises
    ------
    UsageError
        When the installation has lost it.
    """
    for place in (_PACKAGE / "shipped" / "templates", _PACKAGE.parent / "templates"):
        if (place / "page.html.j2").is_file():
            return place
    raise UsageError("certkit's report templates are missing; install certkit again")


def text(name: str) -> str:
    """Return a file of the templates' folder."""
    return (folder() / name).read_text(encoding="utf-8")


@cache
def _environment(code: str) -> SandboxedEnvironment:
    from jinja2 import FileSystemLoader, StrictUndefined  # noqa: PLC0415  # 60 ms that other commands need not pay
    from jinja2.sandbox import SandboxedEnvironment  # noqa: PLC0415  # likewise

    environment = SandboxedEnvironment(
        loader=FileSystemLoader(folder()),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {
        "plain": words.plain,
        "fixed": words.fixed,
        "signed": words.signed,
        "significant": words.significant,
        "signed_significant": words.signed_significant,
        "shown": words.shown,
        "milliseconds": words.milliseconds,
        "stamp_width": _stamp_width,
        "path": _path,
        "tied": _tied,
        "slug_class": words.verdict_class,
    }
    spoken = language(code)
    environment.filters["number_rows"] = partial(number_rows, word=spoken.word)
    environment.globals |= {
        "language": spoken,
        "t": spoken.word,
        "verdict_name": spoken.verdict,
        "title_in": lambda title: title_in(title, spoken),
        "corridor": words.corridor,
        "signs": words.SIGNS,
        "confidence_words": words.CONFIDENCE,
    }
    return environment


_TIED = re.compile(r"(?<=\d) (?=%|–|N\b|N·m|mm\b|ms\b)|(?<=[≤≥<±–]) (?=[\d−])")


def _tied(words: str) -> str:
    """Return a sentence whose numbers stay on one line with their units, and ranges with their ends."""
    return _TIED.sub("\N{NO-BREAK SPACE}", words)


def _path(path: str) -> str:
    """Return a parameter's path as markup that breaks between its words, not within them."""
    from markupsafe import Markup  # noqa: PLC0415  # comes with jinja2

    return Markup(".<wbr>").join(path.split("."))


def _stamp_width(verdict: str, word: str) -> int:
    """Return the millimetres that a verdict's sign and word take on paper: capitals of 19 or 13 points."""
    across = sum(1.0 if unicodedata.east_asian_width(sign) in "WF" else 0.66 for sign in word.upper())
    return round(24 + across * 0.353 * (13 if verdict == "not evaluated" else 19))


def fill(name: str, *, spoken: str = ENGLISH, **values: Any) -> str:  # noqa: ANN401  # templates take anything
    """Fill a template in a language; everything that is not one of our own drawings is escaped."""
    return _environment(spoken).get_template(name).render(**values)
