"""Pages that are shown as they are, in the report's own style; some with a script of ours."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from certkit._version import __version__
from certkit.reporting.html_report import joined, page_style, policy
from certkit.reporting.language import ENGLISH
from certkit.reporting.templating import fill

if TYPE_CHECKING:
    from collections.abc import Sequence


def static_page(
    template: str,
    title: str,
    *,
    spoken: str = ENGLISH,
    more_style: str = "",
    scripts: Sequence[str] = (),
    **values: Any,  # noqa: ANN401  # templates take anything
) -> str:
    """Fill a template that extends `static-page.html.j2`.

    Parameters
    ----------
    template : str
        Its name.
    title : str
        Title of the page.
    spoken : str
        Language of its fixed words.
    more_style : str
        Rules beside the style of all pages.
    scripts : sequence of str
        Files of the templates' folder that run in the page, one after the other.
    values : object
        What the template shows; escaped, except drawings that it marks as our own.
    """
    style = page_style() + more_style
    script = joined(scripts) if scripts else ""
    return fill(
        template,
        spoken=spoken,
        title=title,
        version=__version__,
        policy=policy(style, script),
        style=style,
        script=script,
        **values,
    )
