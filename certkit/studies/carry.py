"""A study from its document to its files."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from certkit.files import write_whole
from certkit.studies.pages import study_page
from certkit.studies.study import study
from certkit.studies.table import write_table

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from pathlib import Path

    from certkit.definitions.study import Study
    from certkit.studies.runs import Progress
    from certkit.studies.study import Findings

JOURNAL = "runs.jsonl"


def carry_and_write(
    sheet: Study,
    folder: Path,
    formats: Collection[str],
    *,
    library: Sequence[Path] = (),
    processes: int | None = None,
    cluster: str | None = None,
    progress: Progress | None = None,
) -> tuple[Findings, str]:
    """Carry a study out and write its table, its findings and its page.

    Returns
    -------
    Findings
    str
        The findings as JSON text.
    """
    findings = study(
        sheet,
        library=library,
        journal=folder / JOURNAL,
        processes=processes,
        cluster=cluster,
        progress=progress,
    )
    write_table(findings.table, folder, "table", {**findings.units, **findings.output_units}, formats)
    text = json.dumps(findings.document(), ensure_ascii=False, indent=1, allow_nan=False) + "\n"
    write_whole(folder / "study.json", text)
    write_whole(folder / "study.html", study_page(findings))
    return findings, text
