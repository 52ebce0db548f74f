"""Damaged documents: `result.json` and the PDF certificate, held up to `verify`."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import certkit
from certkit.bench.verify import verify
from support.damaged_inputs.variant import Finding, Variant

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    import numpy as np

    from certkit.documents.result import Result

INTACT = Finding(passed=True, values={"content": 1.0})


def json_variants(result: Result, chance: np.random.Generator, count: int) -> Iterator[Variant]:
    """Yield damaged result documents; `verify` may hold only where the content is what it was."""
    text = result.to_json()
    data = json.loads(text)
    leaves = list(_leaves(data, ()))
    for _ in range(count):
        end = int(chance.integers(0, len(text)))
        yield _document("truncated", f"ends at byte {end}", text, text[:end].encode())
        at = int(chance.integers(0, len(text)))
        flipped = bytearray(text.encode())
        flipped[at] ^= 1 << int(chance.integers(0, 7))
        yield _document("text field", f"a bit of byte {at}", text, bytes(flipped))
        path, value = leaves[int(chance.integers(0, len(leaves)))]
        for words, new in (
            ("garbled", "xyzzy"),
            ("lost", ...),
            ("null", None),
            ("a list", [value]),
            ("a huge number", 1e300),
            ("below zero", -7),
        ):
            changed = json.loads(text)
            _set(changed, path, new)
            name = f"{'.'.join(map(str, path))}: {words}"
            yield _document("text field", name, text, json.dumps(changed).encode())
    for words, changed in (
        ("NaN", text.replace('"value":', '"value":NaN,"was":', 1)),
        ("deep", '{"a":' * 3_000 + "1" + "}" * 3_000),
        ("a list", f"[{text}]"),
        ("twice", f"{text}{text}"),
        ("another schema", text.replace("certkit-", "other-", 1)),
        ("a key twice", text.replace("{", '{"verdict":"pass",', 1)),
    ):
        yield _document("text field", words, text, changed.encode())


def pdf_variants(result: Result, folder: Path, chance: np.random.Generator, count: int) -> Iterator[Variant]:
    """Yield certificates with damaged bytes; none may hold unless every object in it is the same."""
    certkit.render(result, folder / "pdf", ["pdf"])
    content = (folder / "pdf/report.pdf").read_bytes()
    for _ in range(count):
        at = int(chance.integers(0, len(content)))
        yield _certificate("truncated", f"ends at byte {at}", content, content[:at])
        flipped = bytearray(content)
        flipped[at] ^= 1 << int(chance.integers(0, 8))
        yield _certificate("text field", f"a bit of byte {at}", content, bytes(flipped))
        yield _certificate(
            "dropped", f"64 zeros at byte {at}", content, content[:at] + bytes(64) + content[at + 64 :]
        )
        yield _certificate("dropped", f"64 bytes lost at {at}", content, content[:at] + content[at + 64 :])


def _document(kind: str, name: str, before: str, after: bytes) -> Variant:
    return Variant("JSON", kind, name, INTACT, _held("result.json", after, lambda: _same_json(before, after)))


def _certificate(kind: str, name: str, before: bytes, after: bytes) -> Variant:
    return Variant("PDF", kind, name, INTACT, _held("report.pdf", after, lambda: _same_pdf(before, after)))


def _held(name: str, content: bytes, same: Callable[[], bool]) -> Callable[[Path], Finding]:
    def attempt(folder: Path) -> Finding:
        (folder / name).write_bytes(content)
        found = verify(folder / name)
        failed = [f"{check.what}: {check.said}" for check in found.checks if not check.holds]
        return Finding(
            found.holds, {"content": 1.0 if same() else 0.0}, said="; ".join(failed[:3]) or "holds"
        )

    return attempt


def _same_json(before: str, after: bytes) -> bool:
    try:
        return bool(json.loads(before) == json.loads(after))
    except ValueError:
        return False


def _same_pdf(before: bytes, after: bytes) -> bool:
    """Compare all objects of two PDF files, streams decoded."""
    return _objects(before) == _objects(after)


def _objects(content: bytes) -> list[bytes] | None:
    import io  # noqa: PLC0415  # with pikepdf

    import pikepdf  # noqa: PLC0415  # an extra

    try:
        with pikepdf.open(io.BytesIO(content)) as pdf:
            return [
                item.read_bytes() if isinstance(item, pikepdf.Stream) else repr(item).encode()
                for item in pdf.objects
            ]
    except Exception:  # noqa: BLE001  # whatever a damaged file raises, it is not the same
        return None


def _leaves(data: Any, path: tuple[Any, ...]) -> Iterator[tuple[tuple[Any, ...], Any]]:  # noqa: ANN401  # any JSON
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        if isinstance(value, dict) or (isinstance(value, list) and value and not isinstance(value[0], float)):
            yield from _leaves(value, (*path, key))
        yield (*path, key), value


def _set(data: Any, path: tuple[Any, ...], value: Any) -> None:  # noqa: ANN401  # any JSON
    for step in path[:-1]:
        data = data[step]
    if value is ...:
        del data[path[-1]]
    else:
        data[path[-1]] = value
