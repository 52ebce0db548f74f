"""The formats of finite-element histories, for extractions and virtual tests: the words that name them.

Each is a file in `certkit.exchange.fe.readers`, called by its words: `ls_dyna_binout.py`. They are listed
apart from it because a case is read and checked without reading any history.
"""

from __future__ import annotations

from typing import Literal

Format = Literal["openradioss native", "openradioss csv", "ls-dyna binout", "tidy csv"]

TABLE: Format = "tidy csv"
"""The format that takes any file, so that it is asked last, wherever it stands in the list."""
