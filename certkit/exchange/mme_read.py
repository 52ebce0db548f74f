"""Read an ISO-MME (ISO/TS 13499) container: a folder or zip archive with a `.mme` file and its channels.

Strict: a wrong sample count, a missing list or an unknown unit is an error. The reader at hand, pyisomme 1.1,
reads on in silence there (without `.chn` it sees no channels) and brings 53 packages with 800 MB; it is an
oracle of the tests.
"""

from __future__ import annotations

import hashlib
import re
from pathlib import Path, PurePosixPath
from types import MappingProxyType
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.definitions.loading.channel_tables import default_channels
from certkit.errors import DataError
from certkit.exchange.codes import CodeTable, code_table, table_of_codes
from certkit.exchange.conditions import mapped_conditions, mme_conditions, together
from certkit.exchange.container import Container, open_container
from certkit.exchange.leniency import Leniency
from certkit.exchange.measured import MeasuredData, SourceFile
from certkit.exchange.mme_channel import MmeChannel, read_channel
from certkit.exchange.mme_checks import check_one_object, data_status_of_test, is_simulated
from certkit.exchange.mme_header import OWN_SIMULATION, Header, read_header
from certkit.exchange.text import decode
from certkit.exchange.timebase import common_base
from certkit.files.limits import MAX_CHANNELS
from certkit.reasons import Reason
from certkit.signals.recording import Channel, Recording, RecordingKind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.definitions.channel_mapping import Mapping
    from certkit.definitions.channels import ChannelTable

_SHOWN = (
    "Laboratory name",
    "Customer name",
    "Title",
    "Date of the test",
    "Type of the test",
    "Subtype of the test",
    "Regulation",
    "Laboratory test ref. number",
    "Name of test object 1",
    "Ref. number of test object 1",
)


class _Listed(Struct, frozen=True):
    """A line of the channel list: the file's name and the code it should have."""

    file: str
    code: str


class _Texts:
    """Reads the container's text files, remembering hashes and encodings."""

    def __init__(self, container: Container, leniency: Leniency) -> None:
        self.container, self.leniency = container, leniency
        self.files: list[SourceFile] = []
        self.encodings: dict[str, str] = {}

    def read(self, name: str) -> str:
        data = self.container.read(name)
        place = self.container.place(name)
        if not data.strip():
            raise DataError(f"{place}: is empty; export the test again")
        text, encoding = decode(data, place)
        self.files.append(SourceFile(name, hashlib.sha256(data).hexdigest()))
        if encoding != "ascii" and encoding not in self.encodings:
            if self.encodings:
                other, elsewhere = next(iter(self.encodings.items()))
                self.leniency.depart(
                    place, f"{encoding} text, but {elsewhere} is {other}", "each file has its own encoding"
                )
            self.encodings[encoding] = name
        return text


def read_mme(
    path: Path,
    mapping: Mapping | None = None,
    *,
    lenient: bool = False,
    tables: Sequence[ChannelTable] = (),
) -> MeasuredData:
    """Read a container.

    Parameters
    ----------
    path : Path
        The test's folder, its zip archive, or the `.mme` file in the folder.
    mapping : Mapping, optional
        A laboratory's own codes, signs and conditions.
    lenient : bool
        List assumptions instead of stopping at departures from the standard.
    tables : sequence of ChannelTable
        Legforms that it may be a test of; its codes tell which. The shipped one when empty.

    Raises
    ------
    DataError
        One line that says what is wrong, where, and what to do.
    """
    leniency = Leniency(lenient=lenient)
    texts = _Texts(open_container(path.parent if path.suffix.lower() == ".mme" else path), leniency)
    master = _only(texts.container, ".mme", path)
    header = read_header(texts.read(master).split("\n"), texts.container.place(master))
    if header.find("Data format edition number") is None:
        leniency.depart(header.place, "no `Data format edition number`", "edition 1.6")
    listed = _channel_list(texts, leniency)
    known = table_of_codes((item.code for item in listed), tables or (default_channels(),))
    table = code_table(mapping, known)
    parts, notes = _channels(texts, listed, known, table, leniency)
    check_one_object([(x.place, *x.belongs) for x in parts], leniency)
    base, values = common_base({x.place: (x.base, x.values) for x in parts}, leniency)
    channels = {
        x.kind.name: Channel(
            x.kind.name, x.kind.title, x.kind.dimension, values[x.place], filtered=x.filtered, notes=x.notes
        )
        for x in sorted(parts, key=lambda x: list(known.kinds).index(x.kind.name))
    }
    told = together(mme_conditions(header, table, leniency), mapped_conditions(mapping, table))
    kind = _kind(parts, header, leniency)
    notes = [*data_status_of_test(header, leniency), *notes, *_unclear_sources(parts)]
    recording = Recording(
        kind=kind,
        time=base.times(),
        channels=MappingProxyType(channels),
        conditions=MappingProxyType({word: item.value for word, item in told.items()}),
        notes=(*notes, *leniency.assumptions),
        source=path.name,
        table=known,
    )
    shown = {words: line.value for words in _SHOWN if (line := header.find(words))}
    files = tuple(sorted(texts.files, key=lambda x: x.name))
    return MeasuredData(recording, files, tuple(leniency.assumptions), shown, told)


def _only(container: Container, suffix: str, path: Path) -> str:
    """Find the one file with that suffix."""
    found = [name for name in container.names if name.lower().endswith(suffix)]
    if not found:
        raise DataError(f"{path}: no {suffix} file; is this the folder of an ISO-MME test? Name that")
    if len(found) > 1:
        raise DataError(
            f"{path}: {len(found)} {suffix} files ({found[0]}, {found[1]}); name the folder of one test"
        )
    return found[0]


def _channel_list(texts: _Texts, leniency: Leniency) -> list[_Listed]:
    """Read the `.chn` file, or, when lenient, the channel files that are there."""
    container = texts.container
    lists = [name for name in container.names if name.lower().endswith(".chn")]
    if not lists:
        leniency.depart(container.label, "no channel list (.chn)", "all channel files that are there")
        names = [name for name in container.names if re.search(r"\.\d{3,}$", name)]
        if not names:
            raise DataError(f"{container.label}: no channel files; export the test again")
        return [_Listed(name, _code_of(texts, name)) for name in names[:MAX_CHANNELS]]
    if len(lists) > 1:
        raise DataError(f"{container.label}: {len(lists)} channel lists ({lists[0]}, {lists[1]}); keep one")
    header = read_header(texts.read(lists[0]).split("\n"), container.place(lists[0]))
    return _listed(header, PurePosixPath(lists[0]), container, leniency)


def _listed(header: Header, place: PurePosixPath, container: Container, leniency: Leniency) -> list[_Listed]:
    """Match the lines of the channel list with the files beside it."""
    announced = header.find("Number of channels")
    if announced is None:
        leniency.depart(header.place, "no `Number of channels`", "the channels that are named")
    by_name = {name.lower(): name for name in container.names}
    found = []
    named = [x for x in header.lines if re.fullmatch(r"name of channel\s+\d+", x.descriptor.lower())]
    for line in named:
        number = line.descriptor.split()[-1]
        code = line.value.partition("/")[0].strip().upper()
        file = by_name.get(str(place.with_suffix(f".{int(number):03d}")).lower())
        if file is None:
            leniency.depart(header.at(line), f"channel {number} ({code}) has no file", "it was not recorded")
        else:
            found.append(_Listed(file, code))
    count = header.count(announced) if announced else len(named)
    if announced and count > MAX_CHANNELS:
        raise DataError(
            f"{header.at(announced)}: {announced.value[:40]} channels; more than {MAX_CHANNELS} are "
            "refused: correct the count"
        )
    if announced and count != len(named):
        leniency.depart(
            header.at(announced),
            f"{announced.value} channels announced, {len(named)} named",
            "the named ones are all there are",
        )
    return found


def _code_of(texts: _Texts, name: str) -> str:
    """Read a channel's code from its own file where no list tells it."""
    place = texts.container.place(name)
    text, _ = decode(texts.container.read(name), place)
    line = read_header(text.split("\n"), place).find("Channel code")
    return line.value.upper() if line else ""


def _channels(
    texts: _Texts, listed: list[_Listed], known: ChannelTable, table: CodeTable, leniency: Leniency
) -> tuple[list[MmeChannel], list[Reason]]:
    """Read the channels that certkit knows; the rest is noted."""
    label = texts.container.label
    wanted: dict[str, _Listed] = {}
    notes: list[Reason] = []
    others: list[str] = []
    for item in listed:
        name = table.channel(item.code)
        if name is None:
            others.append(item.code)
        elif name in wanted:
            wanted[name] = _of_two(name, wanted[name], item, label)
            notes.append(Reason.of("recorded-twice", channel=name, code=wanted[name].code))
        else:
            wanted[name] = item
    parts: list[MmeChannel] = []
    for name, item in wanted.items():
        part = read_channel(
            texts.read(item.file),
            texts.container.place(item.file),
            item.code,
            known.kinds[name],
            table.signs.get(name, 1),
            leniency,
        )
        if isinstance(part, Reason):
            notes.append(part)
        elif part is not None:
            parts.append(part)
    if not parts and wanted:
        said = "; ".join(
            f"{x.parameters['place']}: `{x.parameters['status']}`" for x in notes if "status" in x.parameters
        )
        raise DataError(f"{label}: no channel has data that may be used ({said}); export the test again")
    if not parts:
        seen = ", ".join(others[:3]) or "none"
        raise DataError(
            f"{label}: no channel of a {known.impactor} among its codes ({seen}); "
            "a mapping file can name them"
        )
    if others:
        notes.append(Reason.of("codes-not-used", codes=others))
    return parts, notes


def _kind(parts: Sequence[MmeChannel], header: Header, leniency: Leniency) -> RecordingKind:
    """Tell whether the channels were simulated, here or by others, or measured; they must agree."""
    simulated = [part for part in parts if is_simulated(part.source)]
    if simulated and len(simulated) < len(parts):
        other = next(part for part in parts if not is_simulated(part.source))
        leniency.depart(
            simulated[0].place,
            f"`Data source` is `{simulated[0].source[:40]}`, but {other.place} was measured",
            "the test was measured",
        )
    if len(simulated) < len(parts):
        return "measured"
    own = any(line.value == OWN_SIMULATION for line in header.lines if line.descriptor == "Comments")
    return "simulated" if own else "virtual"


def _unclear_sources(parts: Sequence[MmeChannel]) -> list[Reason]:
    """Say which words for a source tell neither a sensor nor a simulation; such are taken as measured."""
    unclear = {part.source[:60]: part.place for part in reversed(parts) if is_simulated(part.source) is None}
    return [Reason.of("source-not-clear", place=unclear[word], source=word) for word in sorted(unclear)]


def _of_two(name: str, first: _Listed, second: _Listed, label: str) -> _Listed:
    """Choose the unfiltered of two channels of the same name; certkit filters by itself."""
    raw = [item for item in (first, second) if item.code[-1] in "0PQ"]
    if len(raw) != 1:
        raise DataError(
            f"{label}: {first.file} and {second.file} are both {name}; name the right code in a mapping file"
        )
    return raw[0]
