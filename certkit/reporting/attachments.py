"""What a certificate carries inside: the result, its definitions, the channels, and the hashes of all."""

from __future__ import annotations

import hashlib
import json
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.exchange.channels_csv import channels_csv
from certkit.reporting.dcc_report import dcc, lacking

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Result

MANIFEST = "manifest.json"
SCHEMA = "certkit-attachments/1"


class Enclosure(Struct, frozen=True):
    """One attached file."""

    name: str
    role: str
    content: bytes
    relationship: str

    @property
    def sha256(self) -> str:
        """Return its hash."""
        return hashlib.sha256(self.content).hexdigest()


def result_json(result: Result) -> bytes:
    """Return the document as attached: without the solver's seconds, which depend on the machine."""
    if result.quality is not None and result.quality.solver_seconds is not None:
        quality = result.quality.model_copy(update={"solver_seconds": None})
        result = result.model_copy(update={"quality": quality})
    return result.to_json().encode()


def enclosures(result: Result, prefix: str = "") -> list[Enclosure]:
    """Return the files a certificate carries, without their list.

    Parameters
    ----------
    result : Result
        Inputs that hold their text are attached; measured files are represented by `channels.csv`.
    prefix : str
        Put before each name, so that the certificates of a suite do not collide.
    """
    found = [Enclosure(f"{prefix}result.json", "result", result_json(result), "Data")]
    taken = {found[0].name}
    for entry in result.provenance.inputs:
        if entry.text is None:
            continue
        plain = PurePosixPath(entry.path.replace("\\", "/")).name or "input"
        name = f"{prefix}{entry.role}-{plain}".replace(" ", "-")
        number = 2
        while name in taken:
            name = f"{prefix}{entry.role}-{number}-{plain}".replace(" ", "-")
            number += 1
        taken.add(name)
        found.append(Enclosure(name, entry.role, entry.text.encode(), "Source"))
    table = channels_csv(result)
    if table is not None:
        found.append(Enclosure(f"{prefix}channels.csv", "channels", table.encode(), "Data"))
    if not lacking(result):
        found.append(Enclosure(f"{prefix}dcc.xml", "dcc", dcc(result), "Alternative"))
    return found


def manifest(
    parts: Sequence[Enclosure], ids: Sequence[str], spoken: str, title: str | None = None
) -> Enclosure:
    """Return the list of all enclosures with their hashes, itself an enclosure.

    It also tells what the pages are made by beside the documents: their language, and the title of a suite,
    so that they can be made again.
    """
    listed = [{"name": part.name, "role": part.role, "sha256": part.sha256} for part in parts]
    data: dict[str, object] = {"schema": SCHEMA, "certificates": list(ids), "language": spoken}
    data |= {} if title is None else {"title": title}
    data["attachments"] = listed
    content = json.dumps(data, ensure_ascii=False, indent=1) + "\n"
    return Enclosure(MANIFEST, "manifest", content.encode(), "Supplement")
