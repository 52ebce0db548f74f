"""Reports of a result document, for people and for machines. Nothing here computes a verdict or measures."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from certkit.reporting.writing import FORMATS, render, render_extraction, render_suite

if TYPE_CHECKING:
    from certkit.reporting.figures import figure

__all__ = ["FORMATS", "figure", "render", "render_extraction", "render_suite"]


def __getattr__(name: str) -> Any:  # noqa: ANN401  # a module's attributes are of any type
    """Import `figure` when it is first used: its charts are 20 files that a JUnit report does not need."""
    if name != "figure":
        raise AttributeError(f"module `certkit.reporting` has no `{name}`")
    return import_module("certkit.reporting.figures").figure
