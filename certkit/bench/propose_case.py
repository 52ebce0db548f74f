"""`extract --propose`: a case's histories with a first grouping of its parts, to be edited."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from certkit.definitions.loading.library import load
from certkit.exchange.fe.reading import data_folder, read_case_data
from certkit.identification.grouping_proposal import propose

if TYPE_CHECKING:
    from certkit.definitions.loading.overrides import Overrides
    from certkit.identification.grouping_proposal import Proposal, ProposedPath

HEAD = "# Proposed by certkit extract --propose from part positions and names; check every line, and edit."


def proposed_case(
    case: str | Path, *, data: str | Path | None = None, overrides: Overrides | None = None
) -> str:
    """Return a case's text with proposed groups and paths in place of its own, or behind it.

    Parameters
    ----------
    case : str or Path
        A case; `histories` is enough.
    data : str or Path, optional
        Folder to take the histories from; the case's own when missing.
    overrides : mapping, optional
        Values of the case to change, by their paths.

    Raises
    ------
    DefinitionError
        When the case cannot be used.
    DataError
        When its histories are missing or damaged, or nothing moves in them.
    """
    path = Path(case)
    document = load("case", path, overrides=overrides or {}).document
    folder = Path(data) if data is not None else data_folder(document.histories, path.parent)
    read = read_case_data(document.histories, folder)
    kept, inside = [], False
    for line in path.read_text(encoding="utf-8").splitlines():
        if line and not line[0].isspace() and not line.startswith("#"):
            inside = line.startswith(("groups:", "paths:"))
        if not inside:
            kept.append(line)
    return "\n".join([HEAD, *kept, *_lines(propose(read.histories, read.faces)), ""])


def _lines(proposal: Proposal) -> list[str]:
    lines = ["groups:"]
    for name, (kind, part) in proposal.groups.items():
        rule, why = "", ""
        if name in proposal.by_centre:
            rule = ", moves with: centre of gravity"
            why = "  # its front was not recorded; nodes on it would be better"
        lines.append(f'  {name}: {{kind: {kind}, parts: ["{part}"]{rule}}}{why}')
    lines.append("paths:")
    lines += [_path(path) for path in proposal.paths]
    if proposal.left_over:
        lines.append(
            "# In none of these paths; give each to the two groups that it lies between, or leave it:"
        )
        lines += [f"#   {name}" for name in proposal.left_over]
    return lines


def _path(path: ProposedPath) -> str:
    words = [f"between: [{', '.join(path.between)}]"]
    words += [f'{key}: "{value}"' for key in ("contact", "spring") if (value := getattr(path, key))]
    words += ["tension: true"] if path.tension else []
    words += [] if path.law else ["law: false"]
    return f"  - {{{', '.join(words)}}}  # {path.because}"
