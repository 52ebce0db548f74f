"""The schemes of a campaign, with their corridor sets and what the campaign asks of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from certkit.definitions.loading.library import load
from certkit.definitions.units import parse_quantity
from certkit.errors import UsageError
from certkit.grading.scheme_terms import SchemeTerms

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.definitions.campaign import Campaign
    from certkit.definitions.loading.library import Library, Loaded
    from certkit.definitions.scheme import Scheme


def campaign_schemes(sheet: Campaign, library: Library) -> tuple[list[SchemeTerms], list[Loaded[Any]]]:
    """Load what a campaign names.

    Returns
    -------
    terms : list of SchemeTerms
        Of each scheme, the maker's own targets last.
    loaded : list of Loaded
        The schemes and corridor sets.

    Raises
    ------
    UsageError
        When they do not fit together, or the campaign asks for what a scheme does not have.
    """
    used: dict[tuple[str, str], Loaded[Any]] = {}
    terms = []
    for name in sheet.schemes:
        terms.append(_scheme(name, library, used, at_least=sheet.at_least.get(name)))
        if name in sheet.at_least and not terms[-1].car_points:
            raise UsageError(f"`at least`: the scheme {name} has no rule for a total; leave it out")
    if sheet.targets is not None:
        target = sheet.targets
        own = _scheme(target.of, library, used)
        if own.scheme.limits is None:
            raise UsageError(
                f"`targets` are shares of limits; the scheme {target.of} has none"
                "; leave `targets` out, or name a scheme with limits"
            )
        shares = {name: parse_quantity(text, "ratio") for name, text in target.criteria.items()}
        share = parse_quantity(target.share, "ratio")
        terms.append(SchemeTerms(own.scheme, own.corridors, share, shares, own_targets=True))
    impactors = list(dict.fromkeys(each.scheme.impactor for each in terms))
    if len(impactors) > 1:
        raise UsageError(
            f"the schemes are for different legforms ({', '.join(impactors)}); a campaign is of one"
            "; name schemes of one legform"
        )
    _check_zones(sheet, terms)
    return terms, list(used.values())


def _scheme(
    name: str,
    library: Library,
    used: dict[tuple[str, str], Loaded[Any]],
    *,
    at_least: float | None = None,
) -> SchemeTerms:
    scheme = load("scheme", name, library=library)
    document = cast("Scheme", scheme.document)
    corridors = load("corridors", document.corridors, library=library)
    used |= {("scheme", name): scheme, ("corridors", corridors.name): corridors}
    return SchemeTerms(document, corridors.document, at_least=at_least)


def _check_zones(sheet: Campaign, terms: Sequence[SchemeTerms]) -> None:
    """Refuse relaxed zones that no scheme knows, or that are wider together than it allows."""
    width = sum(end - start for start, end in sheet.zones)
    allowed = [each.scheme.relaxation for each in terms if each.scheme.relaxation is not None]
    if sheet.zones and not allowed:
        raise UsageError("`relaxed`: none of the schemes has relaxed limits; leave it out")
    for rule in allowed:
        if width > rule.metres + 1e-9:
            raise UsageError(
                f"`relaxed`: the zones are {1e3 * width:g} mm wide together; at most {rule.width} may be"
                "; make them narrower"
            )
