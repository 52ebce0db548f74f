"""The laboratory's header (the items of ISO/IEC 17025, 7.8), whatever it holds: rows, tables and a logo."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

_LOGO = re.compile(r"data:image/(?:png|jpeg);base64,[A-Za-z0-9+/]+={0,2}")


@dataclass(frozen=True)
class HeaderTable:
    """A list of like entries, e.g. sensors with serial and calibration date."""

    title: str
    heads: list[str]
    rows: list[list[str]]


@dataclass(frozen=True)
class LaboratoryView:
    """What the header shows."""

    rows: list[tuple[str, str]]
    tables: list[HeaderTable]
    logo: str | None


def words(key: str) -> str:
    """Turn a key into words."""
    return key.replace("_", " ")


def _text(value: object) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "–" if value is None else str(value)


def laboratory_view(header: dict[str, Any] | None) -> LaboratoryView | None:
    """Flatten the header: scalars become rows, mappings rows with joined names, lists of mappings tables.

    A logo is shown only when it is an embedded PNG or JPEG; anything else that claims to be one is left out.
    """
    if not header:
        return None
    rows: list[tuple[str, str]] = []
    tables: list[HeaderTable] = []
    logo: str | None = None
    for key, value in header.items():
        if key == "logo":
            logo = value if isinstance(value, str) and _LOGO.fullmatch(value) else None
        elif isinstance(value, dict):
            rows += [(f"{words(key)}: {words(str(k))}", _text(v)) for k, v in value.items() if v is not None]
        elif isinstance(value, list) and value and all(isinstance(v, dict) for v in value):
            heads = list(dict.fromkeys(k for entry in value for k in entry))
            cells = [[_text(entry.get(h)) for h in heads] for entry in value]
            tables.append(HeaderTable(words(key), [words(h) for h in heads], cells))
        elif isinstance(value, list):
            rows.append((words(key), ", ".join(_text(v) for v in value) or "–"))
        elif value is not None:
            rows.append((words(key), _text(value)))
    return LaboratoryView(rows, tables, logo)
