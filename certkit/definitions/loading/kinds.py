"""The kinds of definition: the key each file starts with, its document, and the folder it is kept in."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, cast

from msgspec import Struct

from certkit.errors import DefinitionError, UsageError

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from pydantic import BaseModel

    from certkit.definitions.loading.yaml_reader import Tree
    from certkit.errors import Problem


class Kind(Struct, frozen=True):
    """One kind of definition file.

    Parameters
    ----------
    word : str
        The key that a file of this kind starts with; its value is the definition's name.
    title : str
        What the file is, in a few words.
    home : str
        `module:class` of its document, imported when first needed.
    folder : str
        Where the library keeps such files; empty for files that are only ever named by their path.
    checks : str
        `module:function` that looks at the whole file.
    old_forms : str
        `module:function` that brings an old form of the file into today's; see `loading.old_forms`.
    """

    word: str
    title: str
    home: str
    folder: str = ""
    checks: str = ""
    old_forms: str = ""

    @property
    def noun(self) -> str:
        """Return what one such definition is called in a sentence."""
        return "corridor set" if self.word == "corridors" else self.word

    @property
    def prefix(self) -> str:
        """Return what stands before the paths of a definition that a procedure names: `vehicle.`."""
        return f"{self.word}." if self.word in {"legform", "vehicle"} else ""

    def answers_to(self, word: str) -> bool:
        """Tell whether a word means this kind: its own word, its plural or singular, or its folder."""
        last = self.folder.rpartition("/")[2]
        return word in {self.word, f"{self.word}s", self.word.rstrip("s"), self.folder, last} - {""}

    def lives_in(self, folder: Path) -> bool:
        """Tell whether a folder is one that a library keeps this kind in."""
        parts = PurePath(self.folder).parts
        return bool(parts) and folder.parts[-len(parts) :] == parts

    @property
    def model(self) -> type[BaseModel]:
        """Return the document's class."""
        return cast("type[BaseModel]", _named(self.home))

    @property
    def check(self) -> Callable[..., list[Problem]] | None:
        """Return the check of a whole file, if there is one: of its tree, asking a `library`."""
        return cast("Callable[..., list[Problem]]", _named(self.checks)) if self.checks else None

    @property
    def modernise(self) -> Callable[..., Any] | None:
        """Return what brings an old form of a file into today's, if there is one; see `loading.old_forms`."""
        return cast("Callable[..., Any]", _named(self.old_forms)) if self.old_forms else None


@cache
def _named(home: str) -> object:
    module, name = home.split(":")
    return getattr(import_module(f"certkit.definitions.{module}"), name)


_ALL = (
    Kind(
        "procedure",
        "a test: rig, criteria, preconditions",
        "procedure:Procedure",
        "procedures",
        "loading.consistency_checks:check_procedure",
    ),
    Kind("corridors", "corridors, limits and scores", "corridor_set:CorridorSet", "corridors"),
    Kind(
        "legform",
        "masses, stiffnesses and geometry of a leg",
        "legform:Legform",
        "models/legforms",
        old_forms="loading.old_forms:legform",
    ),
    Kind(
        "vehicle",
        "a car front as the leg meets it",
        "vehicle:Vehicle",
        "models/vehicles",
        "loading.consistency_checks:check_vehicle",
        "loading.old_forms:vehicle",
    ),
    Kind("case", "finite-element histories that a vehicle is extracted from", "extraction_case:Case"),
    Kind(
        "reference",
        "values to compare with",
        "reference:Reference",
        "references",
        "loading.consistency_checks:check_reference",
    ),
    Kind(
        "family",
        "legs that all pass the same tests, as changes of one legform",
        "legform_family:Family",
        "models/legforms/families",
    ),
    Kind(
        "study", "many runs: what varies, how, and what is wanted from it", "study:Study", "examples/studies"
    ),
    Kind(
        "fit",
        "parameters of a leg and the tests they are fitted to",
        "calibration:CalibrationTask",
        "models/fits",
    ),
    Kind(
        "diagnosis", "parts of a leg that age or are set wrongly", "diagnosis:Diagnosis", "models/diagnoses"
    ),
    Kind(
        "budget",
        "tolerances of a rig and of its sensors",
        "uncertainty_budget:UncertaintyBudget",
        "examples/uncertainty",
    ),
    Kind(
        "bibliography",
        "works that sources point into",
        "bibliography:Bibliography",
        "references/bibliography",
    ),
    Kind("laboratory", "who tested what, when, with which sensors", "laboratory:Laboratory"),
    Kind("mapping", "how a laboratory's files become channels", "channel_mapping:Mapping"),
    Kind(
        "agreement",
        "what a comparison of two tests has to keep",
        "agreement_rule:AgreementRule",
        "agreement",
    ),
    Kind("scheme", "how impact points add up to a judgement of a car", "scheme:Scheme", "schemes"),
    Kind("campaign", "a car, its impact points and the sources of their values", "campaign:Campaign"),
    Kind("logbook", "how long a certification is good for", "logbook_rules:LogbookRules"),
    Kind(
        "confirmation",
        "numbers of a definition that were held against a text",
        "confirmation:Confirmation",
        "confirmations",
    ),
)

KINDS = {kind.word: kind for kind in _ALL}


def kind_of(word: str) -> Kind:
    """Return a kind by its word, also by its plural or its folder's name.

    Raises
    ------
    UsageError
        When there is no such kind; names those there are.
    """
    from certkit.definitions.loading.error_messages import suggestion  # noqa: PLC0415  # only when wrong

    for kind in _ALL:
        if kind.answers_to(word):
            return kind
    raise UsageError(f"`{word}` is no kind of definition; {suggestion(word, list(KINDS))}")


def refuse_another_kind(kind: Kind, tree: Tree) -> None:
    """Say of a file of another kind that it is one, not every key that it lacks.

    Raises
    ------
    DefinitionError
    """
    first = next(iter(tree.data), "")
    if first in KINDS and first != kind.word and kind.word not in tree.data:
        message = f"this is a {KINDS[first].noun}, no {kind.noun}; name the file of a {kind.noun}"
        raise DefinitionError([tree.problem((first,), message, key=True)])
