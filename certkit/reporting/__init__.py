"""Reports of a result document, for people and for machines. Nothing here computes a verdict or measures."""

from certkit.reporting.figures import figure
from certkit.reporting.writing import FORMATS, render, render_extraction, render_suite

__all__ = ["FORMATS", "figure", "render", "render_extraction", "render_suite"]
