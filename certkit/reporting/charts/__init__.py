"""Figures of a result, each a function from parts of the document to one SVG string."""
