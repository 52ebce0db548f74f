"""Whether the contacts and springs of a path are those of its groups, as far as their names tell."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.exchange.fe.histories import match_one

if TYPE_CHECKING:
    from collections.abc import Iterator

    from certkit.exchange.fe import PartHistories
    from certkit.identification.grouping import Graph


def misnamed_records(graph: Graph, histories: PartHistories) -> list[str]:
    """Warn of a contact or spring that is named after a part of another group than those of its path.

    Momentum does not always tell: contacts that are swapped leave the sum over all groups as it was. A name
    tells where a part's whole name stands in it.
    """
    owner = {part: name for name, parts in graph.groups.items() for part in parts}
    said = []
    for kind, record, path, ends in _records(graph, histories):
        named = {part for part in owner if part in record}
        # Of names that stand in each other, such as `beam` and `beam_rear`, the longest counts.
        named -= {part for part in named for other in named if part != other and part in other}
        said += [
            f"{path}: the {kind} `{record}` is named after `{part}`, which is in the group `{owner[part]}`; "
            "is it in the wrong path, or the part in the wrong group?"
            for part in sorted(named)
            if owner[part] not in ends
        ]
    return said


def _records(graph: Graph, histories: PartHistories) -> Iterator[tuple[str, str, str, set[str]]]:
    """Yield the kind and name of each record that a path takes, with the path's name and groups."""
    for link in graph.links:
        ends = {link.source, link.target}
        for pattern in link.contacts:
            yield "contact", match_one(pattern, histories.contacts, "contact", ""), link.name, ends
        for pattern in link.springs:
            yield "spring", match_one(pattern, histories.springs, "spring", ""), link.name, ends
