"""Reports of documents, for people and for machines. Nothing here computes a verdict or measures."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from certkit.reporting.figures import figure
    from certkit.reporting.writing import FORMATS, render, render_extraction, render_suite

__all__ = ["FORMATS", "figure", "render", "render_extraction", "render_suite"]


def __getattr__(name: str) -> Any:  # noqa: ANN401  # a module's attributes are of any type
    """Import what is used: a list of figures for the command's help needs none of the others."""
    if name not in __all__:
        raise AttributeError(f"module `certkit.reporting` has no `{name}`")
    module = "figures" if name == "figure" else "writing"
    return getattr(import_module(f"certkit.reporting.{module}"), name)
