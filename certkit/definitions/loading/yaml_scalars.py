"""Plain YAML scalars by the core schema of YAML 1.2: `no` is a word, `12:30` is a word, `1e-3` is a number.

PyYAML resolves by YAML 1.1, where `no` is false, `12:30` is 750, `010` is 8 and `1e-3` is a word.
"""

from __future__ import annotations

import math
import re

_CONSTANTS: dict[str, bool | None] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL"), None),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}
_INTEGER = re.compile(r"[-+]?[0-9]{1,300}")
_FLOAT = re.compile(r"[-+]?(?:\.[0-9]{1,300}|[0-9]{1,300}(?:\.[0-9]{0,300})?)(?:[eE][-+]?[0-9]{1,9})?")
_SPECIAL = re.compile(r"[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)")


class WrittenInt(int):
    """An integer that remembers how it was written, so that `010` can still be a serial number."""

    written: str

    def __str__(self) -> str:
        """Return it as it was written."""
        return self.written


class WrittenFloat(float):
    """A number that remembers how it was written, so that clause `1.20` does not become 1.2."""

    written: str

    def __str__(self) -> str:
        """Return it as it was written."""
        return self.written


Scalar = str | int | float | bool | None


def plain_scalar(text: str) -> Scalar:
    """Return what an unquoted scalar means; whatever is no constant and no number is a word."""
    if text in _CONSTANTS:
        return _CONSTANTS[text]
    if _INTEGER.fullmatch(text):
        whole = WrittenInt(text)
        whole.written = text
        return whole
    if _FLOAT.fullmatch(text):
        number = WrittenFloat(text)
        number.written = text
        return number
    if _SPECIAL.fullmatch(text):
        return math.nan if "n" in text.lower()[1:2] else math.copysign(math.inf, -1 if text[0] == "-" else 1)
    return text
