"""What the shell offers when somebody presses Tab."""

from __future__ import annotations


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
