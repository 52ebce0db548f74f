"""What the shell offers when somebody presses Tab."""

from __future__ import annotations

from typer import Context  # noqa: TC002  # typer reads the annotations

SPECIMENS = ("legform", "vehicle")
"""What `--set` exchanges as a whole, by a name."""


def kinds(incomplete: str) -> list[str]:
    """Offer the kinds of definition."""
    from certkit.definitions.loading.kinds import KINDS  # noqa: PLC0415  # pydantic waits until somebody asks

    return [word for word in KINDS if word.startswith(incomplete)]


def kinds_and_documents(incomplete: str) -> list[str]:
    """Offer whatever has a schema."""
    from certkit.documents.document_kinds import DOCUMENTS  # noqa: PLC0415  # as above

    return [word for word in [*kinds(""), *DOCUMENTS] if word.startswith(incomplete)]


def procedures(incomplete: str) -> list[str]:
    """Offer the shipped procedures."""
    from certkit.definitions.loading.library import names  # noqa: PLC0415  # as above

    return [name for name in names("procedure") if name.startswith(incomplete)]


def definitions(incomplete: str) -> list[str]:
    """Offer all shipped definitions."""
    from certkit.definitions.loading.kinds import KINDS  # noqa: PLC0415  # as above
    from certkit.definitions.loading.library import names  # noqa: PLC0415  # as above

    found = {name for kind in KINDS.values() if kind.folder for name in names(kind.word)}
    return sorted(name for name in found if name.startswith(incomplete))


def settings(ctx: Context, incomplete: str) -> list[str]:
    """Offer what `--set` can change in the procedure on the line; behind a `=`, the names that fit."""
    from certkit.definitions.loading.library import names  # noqa: PLC0415  # as above
    from certkit.errors import CertkitError  # noqa: PLC0415  # as above

    path, sign, begun = incomplete.partition("=")
    if sign:
        known = names(path) if path in SPECIMENS else []
        return [f"{path}={name}" for name in known if name.startswith(begun)]
    try:
        found = [*(f"{kind}=" for kind in SPECIMENS), *_paths(_procedure(ctx))]
    except CertkitError:
        found = []  # the command will say what is wrong with the procedure
    return [path for path in found if path.startswith(incomplete)]


def _procedure(ctx: Context) -> str:
    """Return the first procedure that the line names so far, else one that shows what there is."""
    said = [*(ctx.params.get("named") or ()), *(ctx.params.get("procedure") or ())]
    return next((name for name in said if isinstance(name, str) and name), "pendulum")


def _paths(procedure: str) -> list[str]:
    """Return the paths of all numbers of a procedure and of what it names, each with a `=`."""
    from certkit.definitions.loading.library import load  # noqa: PLC0415  # as above
    from certkit.definitions.loading.parameter_list import parameters  # noqa: PLC0415  # as above

    document = load("procedure", procedure).document
    sheets = [("", document), ("legform.", load("legform", document.specimen.legform).document)]
    if document.vehicle is not None:
        sheets.append(("vehicle.", load("vehicle", document.vehicle).document))
    return [f"{prefix}{entry.path}=" for prefix, sheet in sheets for entry in parameters(sheet)]
