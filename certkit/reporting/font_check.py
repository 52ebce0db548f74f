"""Whether a font with a language's signs is installed: a page of empty boxes is no report."""

from __future__ import annotations

import shutil
import subprocess

from certkit.errors import MissingPartError

PACKAGES = {"ja": "fonts-noto-cjk", "zh": "fonts-noto-cjk", "ko": "fonts-noto-cjk"}
"""Debian package with a font for languages that the shipped font has no signs for."""


def check_font(spoken: str) -> None:
    """Refuse a PDF in a language that no installed font can write.

    Only fontconfig knows what is installed; where its `fc-list` is missing, nothing is refused.

    Raises
    ------
    MissingPartError
        Says which font to install.
    """
    package = PACKAGES.get(spoken)
    command = shutil.which("fc-list")
    if package is None or command is None:
        return
    listed = subprocess.run(  # noqa: S603  # our own words alone
        [command, f":lang={spoken}", "family"], capture_output=True, check=False, timeout=60
    )
    if not listed.stdout.strip():
        raise MissingPartError(
            f"the PDF in this language (`{spoken}`) needs a font with its signs, and none is installed; on "
            f"Debian and Ubuntu: `apt install {package}`; all other formats do without it"
        )
