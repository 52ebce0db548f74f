"""`extract`: a lumped vehicle front from the finite-element histories that a case names."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from certkit.bench.front_checks import self_checks
from certkit.definitions.loading.library import load
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.errors import DefinitionError
from certkit.exchange.fe.reading import data_folder, read_case_data
from certkit.identification.five_steps import extract as identify
from certkit.identification.part_groups import GroupingError

if TYPE_CHECKING:
    from collections.abc import Callable

    from certkit.definitions.loading.overrides import Overrides
    from certkit.documents.extraction import ExtractionResult

PROCEDURE = "vehicle-fe-front"


def extract(
    case: str | Path,
    *,
    data: str | Path | None = None,
    name: str | None = None,
    overrides: Overrides | None = None,
    procedure: str | Path | None = PROCEDURE,
    tell: Callable[[str], None] = lambda _: None,
) -> ExtractionResult:
    """Extract a lumped vehicle front by momentum and impulse; see `certkit.identification.five_steps`.

    Parameters
    ----------
    case : str or Path
        The case's file: which histories, which groups of parts, which load paths.
    data : str or Path, optional
        Folder to take the histories from, laid out as the case says; the case's own when missing.
    name : str, optional
        What the vehicle is called; as in the case when missing.
    overrides : mapping, optional
        Values of the case to change, by their paths.
    procedure : str or Path, optional
        Which leg hits the front in the self-checks, and how; None leaves them out.
    tell : callable, optional
        Told what is being done.

    Returns
    -------
    ExtractionResult
        `certkit.render` writes it with its vehicle file.

    Raises
    ------
    DefinitionError, UsageError
        When the case cannot be used.
    DataError
        When its histories are missing, damaged or contradictory.
    """
    path = Path(case)
    changes = {**(overrides or {}), **({"vehicle": name} if name else {})}
    loaded = load("case", path, overrides=changes)
    folder = Path(data) if data is not None else data_folder(loaded.document.histories, path.parent)
    tell("reading histories")
    read = read_case_data(loaded.document.histories, folder)
    try:
        result = identify(
            loaded.document,
            folder,
            case_folder=path.parent,
            case_digest={path.name: loaded.sha256},
            progress=tell,
            data=read,
        )
    except GroupingError as error:
        tree = read_tree(loaded.text.encode(), str(path))
        raise DefinitionError([tree.problem(steps, said) for steps, said in error.faults]) from None
    if procedure is None:
        return result
    held = self_checks(loaded.document, read, result, procedure=procedure, tell=tell)
    further = {
        "checks": held.checks,
        "motion": held.motion,
        "warnings": (*result.warnings, *held.warnings),
        "notes": (*result.notes, *held.notes),
    }
    return result.model_copy(update=further).with_id()
