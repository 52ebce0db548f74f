"""What may be the name of a definition."""

from __future__ import annotations

import re

ENDINGS = (".yaml", ".yml")

_NAME = re.compile(r"[^\W_][\w.,()+ -]{0,99}")


def is_name(text: str) -> bool:
    """Tell whether a text is a plain name, which leads to no other folder and to no particular file."""
    return _NAME.fullmatch(text) is not None and ".." not in text and not text.endswith(ENDINGS)
