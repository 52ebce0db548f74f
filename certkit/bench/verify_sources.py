"""Checks against what lies outside a certificate: its recordings, and the definitions that certkit ships."""

from __future__ import annotations

import hashlib
import math
import re
from typing import TYPE_CHECKING

from certkit.bench.compare_documents import differences
from certkit.bench.look_alikes import look_alike
from certkit.bench.regrade import embedded_mapping, embedded_setup
from certkit.bench.verification import Check, fails, holds, left_out, unchecked
from certkit.bench.verify_document import of_another_certkit
from certkit.definitions.loading.kinds import KINDS
from certkit.definitions.loading.library import names, parse
from certkit.definitions.loading.search_path import Found, is_name, shipped_store
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.documents.channel_curves import raw_channels
from certkit.errors import CertkitError
from certkit.exchange.read import read_recording

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    from certkit.documents.result import InputFile, Result
    from certkit.exchange.conditions import Told
    from certkit.signals import Recording

WORDS = re.compile(r"(^|\.)(origin|source|confidence|note|notes|title|clause|method)(\.|$)")
"""Fields of a definition that tell where numbers come from."""

LIMITS = re.compile(
    r"^(windows|polygons|bands|scores)\..+\.(lower|upper|points|full|zero|at|x|y|shares|decimals|exclusive)\b"
)
"""Fields of a corridor that decide; an entry that only one of both has is none of them."""


def source_checks(result: Result, data: Sequence[Path]) -> Iterator[Check]:
    """Compare the recordings that are handed beside a certificate with those that it was made from.

    Hashes of the files first; then, since a hash may be copied into a document, every channel.
    """
    recorded = {item.sha256: item.path for item in result.provenance.inputs if item.role == "recording"}
    if not recorded:
        return
    if not data:
        yield left_out("recording", "sources-not-given")
        return
    seen: set[str] = set()
    for path in data:
        what = f"recording {path.name}"
        try:
            tables = (embedded_setup(result).legform.channel_table,)
            mapping = embedded_mapping(result, tables[0])
            read = read_recording(path, mapping, lenient=True, tables=tables)
        except CertkitError as error:
            yield unchecked(what, "source-unreadable", error=" ".join(str(error).split()))
            continue
        hashes = {file.sha256: file.name for file in read.files}
        known = hashes.keys() & recorded.keys()
        if not known:
            yield fails(what, "source-unknown")
            continue
        seen |= known
        foreign = [hashes[each] for each in hashes.keys() - recorded.keys()]
        if foreign:
            yield fails(what, "source-differs", name=min(foreign))
            continue
        yield from _channel_checks(what, result, read.recording)
        yield from _told_checks(what, result, read.told)
    missing = sorted(path for sha256, path in recorded.items() if sha256 not in seen)
    if missing:
        yield unchecked("recording", "source-missing", names=", ".join(missing[:3]))


def _channel_checks(what: str, result: Result, recording: Recording) -> Iterator[Check]:
    held = raw_channels(recording)
    for name, series in (result.channels.series if result.channels else {}).items():
        now = held.series.get(name) if held is not None else None
        if now is None or any(differences(series.values, now.values)):
            yield fails(what, "channels-of-source-differ", channel=name)
            return
    yield holds(what, "source-same")


def _told_checks(what: str, result: Result, told: Mapping[str, Told]) -> Iterator[Check]:
    """Compare what the files tell of the test's conditions with what the certificate says they told."""
    for word, item in told.items():
        said = result.conditions.get(word)
        if said is not None and not math.isclose(said, item.value, rel_tol=1e-6, abs_tol=1e-12):
            yield fails(what, "condition-of-source-differs", condition=word, said=said, made=item.value)


def definition_checks(result: Result) -> Iterator[Check]:
    """Compare the definitions that a certificate carries with the shipped ones of their names."""
    for item in result.provenance.inputs:
        if item.text is None or item.role not in KINDS:
            continue
        try:
            yield from _definition_check(result, item, item.text)
        except CertkitError as error:
            yield fails(f"{item.role} {item.path}", "not-gradable", error=" ".join(str(error).split()))


def _definition_check(result: Result, item: InputFile, text: str) -> Iterator[Check]:
    kind = KINDS[item.role]
    name = str(read_tree(text, item.path).data.get(item.role))
    shipped = shipped_store().find(kind, name) if is_name(name) else None
    what = f"{item.role} {name}"
    if shipped is None:  # of one's own, under a name of its own
        other = look_alike(name, names(item.role))
        if other is not None:
            yield unchecked(what, "look-alike-name", name=other)
        return
    if hashlib.sha256(shipped.data).digest() == hashlib.sha256(text.encode()).digest():
        yield holds(what, "as-shipped")
        return
    carried = parse(kind, Found(item.path, text.encode(), item.path))
    found = list(differences(carried.document, parse(kind, shipped).document))
    if not found:
        yield holds(what, "text-differs")
        return
    limits = [each for each in found if item.role == "corridors" and LIMITS.search(each.place)]
    first = (limits or [each for each in found if not WORDS.search(each.place)] or found)[0]
    told = {"place": first.place, "said": first.said, "made": first.made}
    if limits:
        yield fails(what, "limits-differ", **told)
    elif item.path != shipped.label:
        yield unchecked(what, "definition-of-ones-own", **told)
    elif of_another_certkit(result):
        yield unchecked(what, "definition-of-another-version", **told)
    else:
        yield fails(what, "claims-to-be-shipped", **told)
