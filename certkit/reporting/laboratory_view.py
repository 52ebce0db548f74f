"""What ISO/IEC 17025, 7.8, asks of a report, from the laboratory's header: facts, tables, logo, signatories.

A header is plain data. What certkit's own laboratory file gives has its place in the report; anything else
that a header holds is shown as well, under its own words.
"""

from __future__ import annotations

import re
from datetime import date
from typing import TYPE_CHECKING, Any

from msgspec import Struct, field

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    Translate = Callable[..., str]

_LOGO = re.compile(r"data:image/(?:png|jpeg);base64,[A-Za-z0-9+/]+={0,2}")

Facts = list[tuple[str, str]]

SIGNATORIES = 2
"""Lines for signatures that a report has at least."""

_PLACED = {"laboratory", "place", "country", "contact", "accreditation", "logo"}
_PLACED |= {"customer", "item", "test", "persons"}
_PLACED |= {"sensors", "equipment"}


class HeaderTable(Struct, frozen=True):
    """A list of like entries, e.g. sensors with serial and calibration date."""

    title: str
    heads: list[str]
    rows: list[list[str]]


class LaboratoryView(Struct, frozen=True):
    """What the report shows of laboratory, customer, item and test.

    Parameters
    ----------
    name : str
        The laboratory's.
    logo : str or None
        Embedded picture.
    number, revision : str
        Of the report; empty where none is given.
    issued : str
        Day of issue.
    groups : list of (str, list of (str, str))
        Facts under a heading each: laboratory, customer, item, test.
    tables : list of HeaderTable
        Equipment with its calibration, and lists of a header's own.
    signatories : list of (str, str)
        Name and role for each line of the signature block; empty ones are to be filled in by hand.
    persons : list of (str, str)
        All who answer for the test, by their role.
    amendment : list of (str, str)
        What the report replaces, why, and what was changed; empty for a first report.
    """

    name: str
    logo: str | None
    number: str
    revision: str
    issued: str
    groups: list[tuple[str, Facts]]
    tables: list[HeaderTable]
    signatories: list[tuple[str, str]]
    persons: Facts
    amendment: Facts = field(default_factory=list)

    @property
    def rows(self) -> Facts:
        """All facts in one list."""
        return [fact for _, facts in self.groups for fact in facts]


def words(key: str) -> str:
    """Turn a key into words."""
    return key.replace("_", " ")


def _text(value: object) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "–" if value is None else str(value)


def laboratory_view(header: dict[str, Any] | None, t: Translate) -> LaboratoryView | None:
    """Sort a header into a report's parts.

    Parameters
    ----------
    header : dict, optional
        Of a result.
    t : callable
        Gives a fixed word in the language.

    Returns
    -------
    LaboratoryView or None
        None without a header. A logo is shown only when it is an embedded PNG or JPEG; anything else that
        claims to be one is left out.
    """
    if not header:
        return None
    part = {name: value if isinstance(value := header.get(name), dict) else {} for name in _PLACED}
    test, logo, persons = part["test"], header.get("logo"), _persons(header.get("persons"))
    return LaboratoryView(
        name=_text(header.get("laboratory") or header.get("name") or t("Laboratory")),
        logo=logo if isinstance(logo, str) and _LOGO.fullmatch(logo) else None,
        number=str(test.get("number") or ""),
        revision=str(test.get("revision") or 0) if test.get("number") or test.get("revision") else "",
        issued=str(test.get("issued") or ""),
        groups=[group for group in _groups(header, part, t) if group[1]],
        tables=_tables(header, str(test.get("performed") or ""), t),
        signatories=_signatories(persons),
        persons=[(role or t("Name"), name) for name, role, _ in persons],
        amendment=[
            (t(title), str(test[key]))
            for title, key in (
                ("Replaces report", "replaces"),
                ("Reason", "reason"),
                ("What was changed", "changes"),
            )
            if test.get(key)
        ],
    )


def _groups(
    header: dict[str, Any], part: dict[str, dict[str, Any]], say: Translate
) -> list[tuple[str, Facts]]:
    """Return the facts under their headings; what has no place of its own comes last."""
    unsaid = say("not stated")
    item, test = part["item"], part["test"]
    own = {key: value for key, value in header.items() if key not in _PLACED and key != "name"}
    laboratory: Facts = [
        (say("Laboratory"), _text(header.get("laboratory") or header.get("name") or unsaid)),
        (say("Place"), _text(header.get("place") or unsaid)),
        (say("Contact"), _text(header.get("contact") or "")),
        (say("Accreditation"), _text(header.get("accreditation") or "")),
    ]
    customer = header.get("customer")
    client: Facts = [(say("Customer"), _text(customer))] if isinstance(customer, str) else []
    if isinstance(customer, dict):
        client = [
            (say(title), _text(customer[key]))
            for title, key in (("Customer", "name"), ("Address", "address"), ("Order", "reference"))
            if customer.get(key)
        ]
    tested: Facts = [
        (say("Item"), _text(item.get("legform") or unsaid)),
        (say("Serial number"), _text(item.get("serial") or unsaid)),
        (say("Condition"), _text(item.get("condition") or unsaid)),
        (say("Received"), _text(item.get("received") or unsaid)),
    ]
    when: Facts = [
        (say("Tested"), _text(test.get("performed") or unsaid)),
        (say("Issued"), _text(test.get("issued") or unsaid)),
        (say("Place of the test"), _text(test.get("place") or say("at the laboratory"))),
        (say("Deviations from the method"), _text(test.get("method deviations") or say("none stated"))),
    ]
    further = [fact for key, value in own.items() for fact in _flattened(key, value)]
    known = {"number", "revision", "replaces", "reason", "changes"}
    known |= {"performed", "issued", "place", "method deviations"}
    further += [(words(key), _text(value)) for key, value in test.items() if key not in known]
    return [
        (say("Laboratory"), [fact for fact in laboratory if fact[1]]),
        (say("Customer"), client),
        (say("Item tested"), tested if item else []),
        (say("Test"), when if test else []),
        (say("Further details"), further),
    ]


def _flattened(key: str, value: object) -> Facts:
    if isinstance(value, dict):
        return [(f"{words(key)}: {words(str(k))}", _text(v)) for k, v in value.items() if v is not None]
    if isinstance(value, list):
        if any(isinstance(each, dict) for each in value):
            return []
        return [(words(key), ", ".join(_text(each) for each in value) or "–")]
    return [] if value is None else [(words(key), _text(value))]


def _tables(header: dict[str, Any], tested: str, say: Translate) -> list[HeaderTable]:
    """Return the equipment, and lists of a header's own."""
    found = []
    listed = [each for key in ("sensors", "equipment") for each in header.get(key) or ()]
    rows = [
        [
            _text(each.get("channel") or each.get("name")),
            _text(each.get("type") or "–"),
            *(_text(each.get(key)) for key in ("serial", "calibrated", "expires")),
            _covered(each, tested, say),
        ]
        for each in listed
        if isinstance(each, dict)
    ]
    if rows:
        heads = [
            "Channel or equipment",
            "Type",
            "Serial number",
            "Calibrated",
            "Calibration due",
            "On the day",
        ]
        found.append(HeaderTable(say("Equipment and calibration"), [say(head) for head in heads], rows))
    for key, value in header.items():
        if (
            key not in _PLACED
            and isinstance(value, list)
            and value
            and all(isinstance(v, dict) for v in value)
        ):
            names = list(dict.fromkeys(k for entry in value for k in entry))
            cells = [[_text(entry.get(name)) for name in names] for entry in value]
            found.append(HeaderTable(words(key), [words(name) for name in names], cells))
    return found


def _covered(each: dict[str, Any], tested: str, say: Translate) -> str:
    """Tell whether a calibration covered the day of the test."""
    try:
        day = date.fromisoformat(tested)
        holds = date.fromisoformat(str(each.get("calibrated"))) <= day
        holds = holds and day <= date.fromisoformat(str(each.get("expires")))
    except ValueError:
        return "–"
    return say("valid") if holds else say("NOT VALID")


def _persons(header: object) -> list[tuple[str, str, bool]]:
    """Return name, role and whether somebody is marked to sign, from a list of persons or from roles."""
    if isinstance(header, dict):
        return [(_text(name), words(str(role)), False) for role, name in header.items()]
    listed = header if isinstance(header, list) else []
    return [
        (_text(each.get("name")), _text(each.get("role") or ""), bool(each.get("signs")))
        for each in listed
        if isinstance(each, dict)
    ]


def _signatories(persons: Sequence[tuple[str, str, bool]]) -> list[tuple[str, str]]:
    """Return who signs: those that are marked, then others up to two, then lines to be filled in by hand."""
    chosen = [(name, role) for name, role, signs in persons if signs]
    others = [(name, role) for name, role, signs in persons if not signs]
    chosen += others[: max(0, SIGNATORIES - len(chosen))]
    return chosen + [("", "")] * (SIGNATORIES - len(chosen))
