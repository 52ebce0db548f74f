"""The page that says what was shown of the model, from runs made for it, and what was not."""

from docs.make.validation.page import validation

__all__ = ["validation"]
