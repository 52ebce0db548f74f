"""Which languages there are: the files of `languages/`, by their codes (ISO 639-1)."""

from __future__ import annotations

from pathlib import Path

ENGLISH = "en"
"""What documents are written in, and help."""

FOLDER = Path(__file__).resolve().parent / "languages"


def languages() -> list[str]:
    """Return the codes of all languages there are, in alphabetical order."""
    return sorted(path.stem for path in FOLDER.glob("*.yaml"))
