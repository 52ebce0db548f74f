"""A certificate that rests on an assumption says so, holds, and no longer does without its remark."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

import certkit
from certkit.bench.verify import verify
from certkit.documents.result import Result

DATA = Path(__file__).parents[2] / "examples" / "measured" / "FLX-0007-pendulum.zip"


def _channel(folder: Path, change: Callable[[str], str], file: str = "FLX-0007-pendulum.004") -> Path:
    """Unpack a test, and change one of its files."""
    with zipfile.ZipFile(DATA) as archive:
        archive.extractall(folder)
    path = folder / "Channel" / file
    path.write_text(change(path.read_text("latin-1")), "latin-1")
    return folder


def _replaced(words: str, value: str) -> Callable[[Path], Path]:
    return lambda folder: _channel(folder, lambda t: re.sub(rf"(?m)^({words} *:).*", rf"\g<1>{value}", t))


def _turned(folder: Path) -> Path:
    def turn(text: str) -> str:
        head, sign, samples = text.partition("Data status                  :ok\n")
        return head + sign + "\n".join(str(-float(each)) for each in samples.split())

    return _channel(folder, turn)


def _gap(folder: Path) -> Path:
    return _channel(folder, lambda text: text[:-1].rsplit("\n", 1)[0] + "\nNOVALUE\n")


def _table(folder: Path, *, begin: float = -1.0, kind: str = "") -> Path:
    """Write the test as a table, from a time on (s)."""
    folder.mkdir()
    certkit.render(certkit.grade("pendulum", DATA), folder, "csv")
    path = folder / "channels.csv"
    lines = [line for line in path.read_text("utf-8").splitlines() if not line.startswith("# kind")]
    first = next(number for number, line in enumerate(lines) if line.startswith("time"))
    kept = [line for line in lines[first + 1 :] if float(line.partition(",")[0]) >= begin]
    (folder / "result.json").unlink()
    path.write_text("\n".join([kind, *lines[: first + 1], *kept, ""]).lstrip("\n"), "utf-8")
    return path


CASES: dict[str, tuple[Callable[[Path], Path], str]] = {
    "doubtful data": (_replaced("Data status", "questionable data"), "questionable-data"),
    "unclear source": (_replaced("Data source", "unknown"), "source-not-clear"),
    "failed channel": (_replaced("Data status", "channel failed"), "status-not-good"),
    "wrong count": (_replaced("Number of samples", "1999"), "assumed"),
    "gap": (_gap, "left-out"),
    "turned sign": (_turned, "sign-turned"),
    "kind not said": (_table, "kind-not-said"),
    "no rest": (lambda folder: _table(folder, begin=0.0, kind="# kind: measured"), "no-offset-removed"),
}


@pytest.fixture(params=CASES)
def case(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[Result, str]:
    change, code = CASES[request.param]
    return certkit.grade("pendulum", change(tmp_path / "leg"), lenient=True), code


def _on(result: Result, code: str) -> list[int]:
    """Return the numbers of the remarks on an assumption."""
    remarks = enumerate(result.coded_remarks)
    return [n for n, r in remarks if r.code == "accepted-leniently" and f"'{code}'" in str(r.model_dump())]


def test_a_certificate_with_an_assumption_holds_and_says_it(case: tuple[Result, str], tmp_path: Path):
    result, code = case
    assert len(_on(result, code)) == 1
    certkit.render(result, tmp_path / "run", "none")
    found = verify(tmp_path / "run")
    assert found.holds, [(check.what, check.said) for check in found.of("does not hold")]


def test_a_certificate_without_the_remark_on_its_assumption_does_not_hold(
    case: tuple[Result, str], tmp_path: Path
):
    result, code = case
    (number,) = _on(result, code)
    kept = {
        name: [each for n, each in enumerate(getattr(result, name)) if n != number]
        for name in ("remarks", "coded_remarks")
    }
    certkit.render(result.model_copy(update=kept).with_id(), tmp_path / "run", "none")
    assert verify(tmp_path / "run").outcome == "does not hold"
