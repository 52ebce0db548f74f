"""The HTML page: one file, no network, nothing executed that data brought along.

Its content security policy names our own style and script by their hashes, so a browser runs nothing else.
"""

from __future__ import annotations

import base64
import hashlib
import re
from typing import TYPE_CHECKING

from certkit._version import __version__
from certkit.reporting.language import ENGLISH
from certkit.reporting.language_list import languages
from certkit.reporting.page_data import embedded, payload
from certkit.reporting.suite_head import SuiteHead, suite_head
from certkit.reporting.templating import fill, folder, text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.reporting.result_view import View

_LANGUAGE = re.compile(rb'<html lang="([a-z]{2})">')
SCRIPTS = ("scripts/curves.js", "scripts/motion.js", "scripts/page.js")


FILE = "report.html"
SUITE_FILE: str | None = "index.html"
TRANSLATED = True
REPEATABLE = True


def language_of(content: bytes) -> str:
    """Return the language that a page says it is in; English when that is none of ours."""
    said = _LANGUAGE.search(content[:500])
    code = said[1].decode() if said else ENGLISH
    return code if code in languages() else ENGLISH


def page(view: View) -> str:
    """Return the page of one result."""
    return _page([view], [], f"{view.result.title} – {view.spoken.verdict(view.result.verdict)}")


def suite_page(views: Sequence[View], title: str = "Certification suite") -> str:
    """Return one page with an index line a procedure and all their reports below."""
    lines: list[dict[str, object]] = [
        {
            "key": shown.key,
            "subject": shown.subject,
            "legform": shown.specimen_words,
            "reference": shown.reference,
            "procedure": shown.result.procedure,
            "title": shown.result.title,
            "verdict": shown.result.verdict,
            "tally": shown.tally,
            "nearest": shown.nearest,
            "spark": shown.spark,
            "id": shown.result.id,
        }
        for shown in views
    ]
    return _page(views, lines, title, suite_head(views))


def _page(
    views: Sequence[View], index: Sequence[dict[str, object]], title: str, head: SuiteHead | None = None
) -> str:
    style = page_style()
    script = joined(SCRIPTS)
    return fill(
        "page.html.j2",
        spoken=views[0].spoken.code,
        title=title,
        version=__version__,
        policy=policy(style, script),
        style=style,
        script=script,
        index=index,
        head=head,
        reports=[(shown, embedded(payload(shown.result))) for shown in views],
    )


def page_style() -> str:
    """Return the style sheet with its fonts inside: the subset files of the font's own maker."""
    style = text("styles/page.css")
    for key, name in (
        ("regular", "Regular-Latin1"),
        ("signs", "Regular-Pi"),
        ("semibold", "SemiBold-Latin1"),
    ):
        data = base64.b64encode((folder() / "fonts" / f"IBMPlexSans-{name}.woff2").read_bytes()).decode()
        style = style.replace("{{" + key + "}}", f"data:font/woff2;base64,{data}")
    return style


def joined(scripts: Sequence[str]) -> str:
    """Return files of the templates' folder as one script."""
    return "(() => {\n" + "\n".join(text(name) for name in scripts) + "})();"


def policy(style: str, script: str) -> str:
    """Return the content security policy: no network, no code but ours."""
    hashed = {
        name: base64.b64encode(hashlib.sha256(part.encode()).digest()).decode()
        for name, part in (("style", style), ("script", script))
        if part
    }
    return (
        "default-src 'none'; "
        + "".join(f"{name}-src 'sha256-{digest}'; " for name, digest in hashed.items())
        + "font-src data:; img-src data:; base-uri 'none'; form-action 'none'"
    )


def write(views: Sequence[View], *, title: str | None, paper: str) -> str:
    """Return the page of one result, or of a suite where there is a title."""
    del paper
    return page(views[0]) if title is None else suite_page(views, title)
