"""Pages without a script: comparisons and logbooks, in the report's own style."""

from __future__ import annotations

import base64
import hashlib
from typing import Any

from certkit._version import __version__
from certkit.reporting.html_report import page_style
from certkit.reporting.templating import fill


def static_page(
    template: str,
    title: str,
    *,
    more_style: str = "",
    **values: Any,  # noqa: ANN401  # templates take anything
) -> str:
    """Fill a template that extends `static-page.html.j2`.

    Parameters
    ----------
    template : str
        Its name.
    title : str
        Title of the page.
    more_style : str
        Rules beside the style of all pages.
    values : object
        What the template shows; escaped, except drawings that it marks as our own.
    """
    style = page_style() + more_style
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
    policy = (
        f"default-src 'none'; style-src 'sha256-{digest}'; font-src data:; img-src data:; "
        "base-uri 'none'; form-action 'none'"
    )
    return fill(template, title=title, version=__version__, policy=policy, style=style, **values)
