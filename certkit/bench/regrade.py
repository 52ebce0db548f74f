"""Grade a result document again, from the channels and the definitions that it carries."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

from certkit.bench.laboratory_files import ROLE, laboratory_of
from certkit.bench.laboratory_terms import laboratory_terms
from certkit.bench.model_origins import fits_of, fitted_to, model_remarks
from certkit.bench.setup import prepare, without_model
from certkit.bench.virtual_test_terms import virtual_test_terms
from certkit.definitions.channel_mapping import Mapping
from certkit.definitions.loading.channel_tables import legform_channels
from certkit.definitions.loading.kinds import KINDS
from certkit.definitions.loading.search_path import TextStore
from certkit.definitions.loading.validation import validate
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.documents.channel_curves import recording_of, simulated_here
from certkit.errors import DataError, OldFormWarning
from certkit.grading import (
    NO_LABORATORY,
    GradingTerms,
    LaboratoryTerms,
    SimulatedTerms,
    evaluate,
    measure_all,
)
from certkit.reporting.language import worded

if TYPE_CHECKING:
    from certkit.bench.setup import Setup
    from certkit.definitions.channels import ChannelTable
    from certkit.documents.result import Provenance, Result


def embedded_store(provenance: Provenance) -> TextStore:
    """Return the definitions that a document carries, as a place where definitions are looked for."""
    texts = {}
    for item in provenance.inputs:
        if item.text is not None and item.role in KINDS:
            name = read_tree(item.text, item.path).data.get(item.role)
            texts[item.role, str(name)] = item.text
    return TextStore(texts)


def embedded_channels(result: Result) -> ChannelTable | None:
    """Return the channels of the legform whose definition a result carries; None where it carries none."""
    store = embedded_store(result.provenance)
    legform = next((name for kind, name in store.texts if kind == "legform"), None)
    return None if legform is None else legform_channels(legform, (store,))


def embedded_setup(result: Result) -> Setup:
    """Return the procedure and all that it names from what a result carries, with its changed values.

    Raises
    ------
    DataError
        When the document does not carry its own procedure.
    DefinitionError
        When a carried definition cannot be used any more.
    """
    store = embedded_store(result.provenance)
    if ("procedure", result.procedure) not in store.texts:
        raise DataError(
            f"the document does not carry its procedure `{result.procedure}`; it cannot be graded again"
            "; run or grade it anew"
        )
    overrides = {change.path: change.value for change in result.provenance.overrides}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", OldFormWarning)  # whoever verifies did not write them
        setup = prepare(result.procedure, library=(store,), overrides=overrides)
    return setup if simulated_here(result) else without_model(setup)


def regrade(result: Result) -> Result:
    """Grade the carried channels again by the carried definitions, with the values that were changed then.

    Returns
    -------
    Result
        What certkit, as it is today, makes of them; without the notes on the recording's files, and without
        energies, motion and front, which only the simulation knows.

    Raises
    ------
    DataError
        When the document carries no channels, or not its own procedure.
    DefinitionError
        When a carried definition cannot be used any more.
    """
    setup = embedded_setup(result)
    channels = setup.legform.channel_table
    recording = recording_of(result, table=channels)
    laboratory = _laboratory(result, channels)
    if recording.kind == "virtual":
        store = embedded_store(result.provenance)
        mapping = embedded_mapping(result, channels)
        laboratory = virtual_test_terms(laboratory, setup.procedure, recording, mapping, (store,))
    # What was let pass then is let pass now, and listed in the document's notes.
    measured = measure_all(setup.procedure, recording, lenient=True)
    again = evaluate(
        measured,
        GradingTerms(setup.corridors, result.provenance, setup.reference, setup.parameters),
        simulated=_simulated_terms(result, setup),
        laboratory=laboratory,
    )
    return worded(again)


def embedded_mapping(result: Result, channels: ChannelTable) -> Mapping | None:
    """Return the mapping that a result carries; None where it was graded without one."""
    for item in result.provenance.inputs:
        if item.role == "mapping" and item.text is not None:
            return validate(read_tree(item.text, item.path), Mapping, channels=channels)
    return None


def _simulated_terms(result: Result, setup: Setup) -> SimulatedTerms:
    """Return what the simulation told; of the fits that the model was made by, those that certkit ships."""
    numerical = {
        c.id: c.uncertainty.numerical
        for c in result.criteria
        if c.uncertainty is not None and c.uncertainty.numerical is not None
    }
    if not simulated_here(result):
        return SimulatedTerms(quality=result.quality, numerical=numerical)
    fits = fits_of(setup)
    return SimulatedTerms(
        fitted=tuple(fitted_to(setup, fits)),
        bounds=model_remarks(setup, fits, result.front),
        quality=result.quality,
        numerical=numerical,
        legform=setup.legform.title,
    )


def _laboratory(result: Result, channels: ChannelTable) -> LaboratoryTerms:
    sources = [item for item in result.provenance.inputs if item.role == ROLE and item.text is not None]
    if not sources:
        return NO_LABORATORY
    laboratory = laboratory_of(sources, channels)
    number = ""
    if laboratory.numbering is not None and laboratory.test is not None and not laboratory.test.number:
        number = str(((result.laboratory or {}).get("test") or {}).get("number", ""))  # from the register
    return laboratory_terms(laboratory, None, sources, channels, number=number)
