"""`grade`: read a measured test, put its laboratory's words beside it, and grade it like a simulated one."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec.structs import replace

from certkit.bench.data_places import without_folders
from certkit.bench.laboratory_terms import header_contradictions, merged_conditions, read_laboratory
from certkit.bench.setup import prepare, without_model
from certkit.bench.virtual_test_terms import energies_of, virtual_test_terms
from certkit.definitions.channel_mapping import Mapping
from certkit.definitions.loading.validation import read_bytes, validate
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.documents.result import InputFile
from certkit.errors import DataError
from certkit.exchange.read import read_recording
from certkit.files.limits import MAX_CARRIED_VALUES
from certkit.grading import NO_LABORATORY, SimulatedTerms, evaluate, measure_all
from certkit.reasons import Reason
from certkit.reporting.language import worded

if TYPE_CHECKING:
    from certkit.definitions.channels import ChannelTable
    from certkit.definitions.loading.library import Library
    from certkit.definitions.loading.overrides import Overrides
    from certkit.definitions.procedure import Procedure
    from certkit.documents.result import Result
    from certkit.signals import Recording


def grade(
    procedure: str | Path,
    data: str | Path,
    *,
    laboratory: str | Path | None = None,
    mapping: str | Path | None = None,
    lenient: bool = False,
    library: Library = (),
    overrides: Overrides | None = None,
) -> Result:
    """Grade a recorded test: a test evaluation, or a virtual test when it is a finite-element run.

    A recording that certkit simulated and exported stays a virtual certification.

    Parameters
    ----------
    procedure : str or Path
        Name that the library knows, or a file.
    data : str or Path
        ISO-MME folder, archive or `.mme` file, CSV file, the folder of a run with its `channels.csv`, or a
        finite-element run, its folder or its file, with a `mapping` that says what is what.
    laboratory : str or Path, optional
        `lab.yaml`: header, sensors, decision rule, uncertainties, conditions; with the file that it shares.
        Where it has `numbering`, the report's number is entered in its register.
    mapping : str or Path, optional
        The laboratory's columns, codes, signs and conditions.
    lenient : bool
        List assumptions instead of stopping at departures.
    library : str, Path, or sequence of them
        Folders with own definitions, searched first.
    overrides : mapping, optional
        Values of the procedure to change, by their paths.

    Raises
    ------
    DefinitionError, UsageError
        When a definition cannot be used.
    DataError
        When the data cannot.
    """
    setup = without_model(prepare(procedure, library=library, overrides=overrides))
    channels = setup.legform.channel_table
    data = Path(data)
    own, mapping_input = _mapping(None if mapping is None else Path(mapping), channels)
    if (data / "result.json").is_file():
        data = data / "channels.csv"  # the folder of a run
    read = read_recording(data, own, lenient=lenient, tables=(channels,))
    _check_amount(read.recording, data)
    test = " ".join((setup.procedure.procedure, *sorted(file.sha256 for file in read.files)))
    lab = read_laboratory(laboratory, channels, test=test) if laboratory else NO_LABORATORY
    conditions = merged_conditions(read.told, lab.conditions, str(laboratory))
    files = (
        InputFile(role="recording", path=_shown(data, file.name), sha256=file.sha256) for file in read.files
    )
    recording = replace(without_folders(read.recording, data), conditions=conditions)
    header = [f"{words}: {value}" for words, value in read.header.items()]
    odd = header_contradictions(read.header, lab, str(laboratory))
    _check_type(read.header.get("Type of the test", ""), setup.procedure, data)
    made_by = read.header.get("procedure", setup.procedure.procedure)
    if made_by != setup.procedure.procedure:
        odd.append(Reason.of("recorded-by-other-procedure", made=made_by, graded=setup.procedure.procedure))
    if recording.kind == "virtual":
        lab = virtual_test_terms(lab, setup.procedure, recording, own, library)
    result = evaluate(
        measure_all(setup.procedure, recording, lenient=lenient),
        setup.terms(*files, *mapping_input, *lab.inputs),
        laboratory=lab,
        simulated=SimulatedTerms(energies=energies_of(recording, read.energies)),
        notes=[*odd, *(Reason.words(text) for text in (*setup.remarks, *header))],
    )
    return worded(result)


def _mapping(path: Path | None, channels: ChannelTable) -> tuple[Mapping | None, list[InputFile]]:
    if path is None:
        return None, []
    data = read_bytes(path)
    mapping = validate(read_tree(data, str(path)), Mapping, channels=channels)
    digest = hashlib.sha256(data).hexdigest()
    return mapping, [InputFile(role="mapping", path=path.name, sha256=digest, text=data.decode("utf-8-sig"))]


TYPES = {"static": "static", "vehicle": "flight", "bumper": "flight"}
"""Words for a kind of test, and the kind of procedure that they mean."""
NAMES = ("pendulum", "inverse")
"""Words for one of the tests with a blow, which its procedure's name has too."""
PARTS = ("femur", "tibia", "knee")
"""Words for the part that a static test bends."""


def _check_type(told: str, procedure: Procedure, data: Path) -> None:
    """Refuse a test whose header says that it is of another kind.

    Raises
    ------
    DataError
        When it names another kind of test than the procedure's, or a static test of another part.
    """
    words, name = set(re.findall(r"[a-z]+", told.casefold())), procedure.procedure
    fits = [TYPES[word] == procedure.test_kind or word in name for word in TYPES if word in words]
    fits += [word in name for word in NAMES if word in words]
    parts = [word for word in PARTS if word in words]
    of_part = procedure.test_kind != "static" or not parts or procedure.specimen.part in parts
    if not of_part or (fits and not any(fits)):
        raise DataError(
            f"{data}: `Type of the test` is `{told[:40]}`, but it is graded by the procedure {name}; "
            "name the procedure that was carried out with `--procedure`, or correct the header"
        )


def _check_amount(recording: Recording, data: Path) -> None:
    """Refuse more samples than a certificate can carry, before they are graded.

    Raises
    ------
    DataError
        When there are.
    """
    channels, samples = len(recording.channels), recording.time.size
    if channels * samples > MAX_CARRIED_VALUES:
        raise DataError(
            f"{data}: {channels} channels of {samples:,} samples are more than a certificate can carry "
            f"({MAX_CARRIED_VALUES:,} values); cut the record to the test: no test lasts "
            f"{samples * recording.interval:.3g} s"
        )


def _shown(data: Path, name: str) -> str:
    """Name a file without the folders above the test."""
    return f"{data.name}/{name}" if data.is_dir() or data.suffix.lower() == ".zip" else name
