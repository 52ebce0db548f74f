"""A run's binout files, opened through lasso-python, an optional extra that is imported only here.

SMP LS-DYNA writes `binout0000` and goes on in `binout0000%001`, `binout0000%002` …; MPP writes `binout0000`,
`binout0001` … with some tables or objects each, and a restart may begin a new file. What was left out of a
sequence is an error where the sequence itself tells it, a remark where processors may have written nothing.
"""

from __future__ import annotations

import re
import shutil
import tempfile
from glob import escape
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

from certkit.errors import DataError
from certkit.exchange.fe.checks import read_bytes

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

INSTALL = "reading binout files needs lasso-python: pip install 'certkit[binout]'"
_LSDA_HEADER = 8
NEUTRAL = "binout0000"
"""Name of a copy: lasso takes brackets in a path for a pattern, and reads no `.gz`."""


class BinoutFiles:
    """Opened files by their names, what was read, and what there is to say of the set.

    Attributes
    ----------
    readers : list of (str, Binout)
    digests : dict of str to str
        SHA-256 of every file, continuations included.
    remarks : list of str
    """

    def __init__(self, paths: Sequence[Path]) -> None:
        """Open the files.

        Raises
        ------
        DataError
            Without lasso-python, for a file that is no binout or damaged, and for a continuation that is
            missing or begins before its file ends.
        """
        self._folder = tempfile.TemporaryDirectory(prefix="certkit-")
        self.digests: dict[str, str] = {}
        self.readers: list[tuple[str, Any]] = []
        self.remarks = [*_missing_numbers(paths)]
        try:
            for number, path in enumerate(paths):
                place = Path(self._folder.name) / str(number)
                place.mkdir()
                self.readers.append((path.name, self._opened(path, place)))
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Forget the copies that were made to read from."""
        self._folder.cleanup()

    def _opened(self, path: Path, place: Path) -> Any:  # noqa: ANN401  # lasso ships no types
        content, self.digests[str(path)] = read_bytes(path)
        if not is_lsda(content):
            raise DataError(
                f"{path}: this is no LSDA container; a binout starts with its header length 8: "
                "name the binout"
            )
        # LSDA goes on in files of this name; the reader joins them, so they belong to what was read.
        rest = sorted(path.parent.glob(f"{escape(path.name)}%[0-9]*")) if path.suffix != ".gz" else []
        self.digests |= {str(part): read_bytes(part)[1] for part in rest}
        _require_continued(path, rest)
        if path.suffix != ".gz" and str(path) == escape(str(path)) and not rest:
            return _lasso(path, path)
        alone = place / NEUTRAL
        alone.write_bytes(content)
        spans = _spans(alone, path) if rest else []
        for part in rest:
            spans += _spans(part, part)
        _require_order(spans)
        for part in rest:
            shutil.copyfile(part, place / f"{NEUTRAL}%{part.name.rpartition('%')[2]}")
        return _lasso(alone, path)


def is_lsda(content: bytes) -> bool:
    """Tell whether a file's content is an LSDA container, which a binout is."""
    return len(content) >= _LSDA_HEADER and content[0] == _LSDA_HEADER


def _lasso(copy: Path, path: Path) -> Any:  # noqa: ANN401  # lasso ships no types
    """Open a file, or a copy of it, whose continuations lie beside it."""
    try:
        from lasso.dyna import Binout  # noqa: PLC0415  # optional, heavy
        from lasso.dyna.lsda_py3 import Lsda  # noqa: PLC0415  # likewise
    except ImportError:
        raise DataError(f"{path}: {INSTALL}") from None
    if not hasattr(Lsda, "fw"):
        Lsda.fw = None  # its destructor asks for it, also where opening failed, and prints a traceback else
    try:
        return Binout(escape(str(copy)))
    except Exception as error:  # noqa: BLE001  # whatever lasso raises, the file is what is wrong
        raise DataError(f"{path}: lasso-python cannot read it ({error}); was it cut? Copy it again") from None


def _missing_numbers(paths: Sequence[Path]) -> list[str]:
    """Remark on numbers that lack between a run's files: processors that wrote nothing, or a lost file."""
    found: dict[str, list[int]] = {}
    for path in paths:
        named = re.fullmatch(r"(.*?)(\d{4})", path.name.removesuffix(".gz"))
        if named:
            found.setdefault(named[1], []).append(int(named[2]))
    remarks = []
    for stem, numbers in found.items():
        lacking = sorted(set(range(max(numbers))) - set(numbers)) if len(numbers) > 1 else []
        if lacking:
            listed = ", ".join(f"{stem}{number:04d}" for number in lacking[:6])
            remarks.append(
                f"{listed} {'is' if len(lacking) == 1 else 'are'} not among the files: processors that wrote "
                "nothing leave such gaps; if it was lost, tables or objects lack"
            )
    return remarks


def _require_continued(path: Path, rest: Sequence[Path]) -> None:
    numbers = [int(part.name.rpartition("%")[2]) for part in rest if part.name.rpartition("%")[2].isdigit()]
    lacking = sorted(set(range(1, max(numbers, default=0) + 1)) - set(numbers))
    if lacking:
        raise DataError(
            f"{path}: its continuation {path.name}%{lacking[0]:03d} is missing, "
            f"{path.name}%{max(numbers):03d} is there; copy all files of the run"
        )


def _spans(copy: Path, path: Path) -> list[tuple[str, str, float, float]]:
    """Return (table, file, first time, last time) of one file of a sequence, without the others."""
    from lasso.dyna.lsda_py3 import Lsda  # noqa: PLC0415  # optional, heavy

    found = []
    try:
        opened = Lsda([str(copy)], "r")  # kept, because it closes the file when it is forgotten
        for place, times in _times(opened.root):
            found.append((place, path.name, min(times), max(times)))
    except Exception as error:  # noqa: BLE001  # see _lasso
        raise DataError(f"{path}: lasso-python cannot read it ({error}); was it cut? Copy it again") from None
    return found


def _times(symbol: Any, place: str = "") -> Iterator[tuple[str, list[float]]]:  # noqa: ANN401  # no types
    """Yield the times of each table below a folder of the container."""
    times = []
    for name, child in symbol.children.items():
        time = child.children.get(b"time") or child.children.get("time")
        if time is not None:
            times.append(float(time.read()[0]))
        elif child.type == 0:
            word = name.decode() if isinstance(name, bytes) else str(name)
            yield from _times(child, f"{place}/{word}" if place else word)
    if times:
        yield place, times


def _require_order(spans: Sequence[tuple[str, str, float, float]]) -> None:
    for table in {span[0] for span in spans}:
        for (_, name, _, end), (_, following, begin, _) in pairwise(s for s in spans if s[0] == table):
            if begin <= end:
                raise DataError(
                    f"{following}: {table} begins at {begin:g}, before {name} ends at {end:g}, as after "
                    "a restart; give it a number of its own (binout0001) and name both files"
                )
