"""What the shell offers when somebody presses Tab."""

from __future__ import annotations

import os

from typer import Context  # noqa: TC002  # typer reads the annotations

SPECIMENS = ("legform", "vehicle")
"""What `--set` exchanges as a whole, by a name."""

BASH = {"_CERTKIT_COMPLETE": "complete_bash"}
"""How bash asks."""


def words_of_bash() -> list[str] | None:
    """Join what bash took apart: to it, each `=` is a word of its own, so that `a=b` comes as three.

    Returns
    -------
    list of str or None
        What fits behind the `=` that the cursor stands behind, without what is before it, as bash puts it
        there; None where it stands elsewhere.
    """
    words = os.environ.get("COMP_WORDS", "").split("\n")
    place = int(os.environ.get("COMP_CWORD", "0"))
    joined: list[str] = []
    for word in words[: place + 1]:
        if len(joined) > 1 and (word == "=" or joined[-1].endswith("=")):
            joined[-1] += word
        else:
            joined.append(word)
    os.environ["COMP_WORDS"], os.environ["COMP_CWORD"] = "\n".join(joined), str(len(joined) - 1)
    return specimens(joined[-1], before="") if "=" in words[max(0, place - 1) : place + 1] else None


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


def specimens(incomplete: str, before: str | None = None) -> list[str]:
    """Offer names for `legform=…` and `vehicle=…`, with what is `before` them; the path when not given."""
    from certkit.definitions.loading.library import names  # noqa: PLC0415  # as above

    path, _, begun = incomplete.partition("=")
    before = f"{path}=" if before is None else before
    return [before + name for name in names(path) if name.startswith(begun)] if path in SPECIMENS else []


def settings(ctx: Context, incomplete: str) -> list[str]:
    """Offer what `--set` can change in the procedure on the line; behind a `=`, the names that fit."""
    from certkit.errors import CertkitError  # noqa: PLC0415  # as above

    if "=" in incomplete:
        return specimens(incomplete)
    try:
        found = [*(f"{kind}=" for kind in SPECIMENS), *_paths(_procedure(ctx))]
    except CertkitError:
        found = []  # the command will say what is wrong with the procedure
    # Without spaces, so that no shell needs quotes; `--set` takes either.
    begun = incomplete.replace(" ", "_")
    return [path for path in (each.replace(" ", "_") for each in found) if path.startswith(begun)]


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
