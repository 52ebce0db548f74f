"""What pydantic found wrong with a document, said so that a test engineer can put it right."""

from __future__ import annotations

from difflib import get_close_matches
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from certkit.definitions.loading.faults import Faults, Steps
from certkit.definitions.loading.field_types import FieldType, fields

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from pydantic import BaseModel, ValidationError
    from pydantic_core import ErrorDetails

    from certkit.definitions.loading.yaml_reader import Tree
    from certkit.errors import Problem


SHOWN = 12
"""Choices that a message lists, at most."""


def nearest(word: str, choices: Collection[str]) -> str | None:
    """Return the choice that `word` was most likely meant to be; spaces, `_`, `-` and case do not count."""
    known = {plain(choice): choice for choice in choices}
    found = get_close_matches(plain(word), known, n=1, cutoff=0.6)
    return known[found[0]] if found else None


def suggestion(word: str, choices: Collection[str]) -> str:
    """Return `did you mean …?`, or the choices themselves when none is near."""
    near = nearest(word, choices)
    if near is not None:
        return f"did you mean `{near}`?"
    names = sorted(choices)
    rest = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return f"known: {', '.join(names[:SHOWN])}{rest}" if names else "none is known"


def problems(error: ValidationError, tree: Tree, model: type[BaseModel]) -> list[Problem]:
    """Say each of pydantic's findings as a problem with its place in the file.

    Parameters
    ----------
    error : ValidationError
        Raised by `model` for `tree.data`.
    tree : Tree
        The file.
    model : type
        The document's class.
    """
    details = error.errors(include_url=False)
    misspelt = set(_meant(details, tree, model))
    found: list[Problem] = []
    for detail in details:
        steps, last = _located(detail["loc"], tree.data), detail["loc"][-1] if detail["loc"] else ""
        cause = detail.get("ctx", {}).get("error")
        if isinstance(cause, Faults):
            found += [tree.problem(_located((*steps, *way), tree.data), said) for way, said in cause.faults]
        elif detail["type"] == "extra_forbidden":
            message = f"`{last}` is not known here; {suggestion(str(last), _known(steps[:-1], model))}"
            found.append(tree.problem(steps, message, key=True))
        elif detail["type"] != "missing":
            found.append(tree.problem(steps, _sentence(detail)))
        elif (*steps, last) not in misspelt:
            found.append(tree.problem(steps, f"`{last}` is missing{_where(steps)}; add it"))
    return list(dict.fromkeys(found))


def _meant(details: list[ErrorDetails], tree: Tree, model: type[BaseModel]) -> Iterator[Steps]:
    """Yield the paths that misspelt keys were most likely meant to be: those are not missing as well."""
    for detail in details:
        if detail["type"] == "extra_forbidden":
            steps = _located(detail["loc"], tree.data)
            near = nearest(str(steps[-1]), _known(steps[:-1], model))
            if near is not None:
                yield (*steps[:-1], near)


@lru_cache(maxsize=4096)
def plain(word: str) -> str:
    """Return a word as it is compared: case, `_` and `-` do not count."""
    return word.casefold().replace("_", " ").replace("-", " ")


def _where(steps: Steps) -> str:
    return f" in `{steps[-1]}`" if steps and isinstance(steps[-1], str) else ""


def _located(loc: Steps, data: Any) -> Steps:  # noqa: ANN401  # raw YAML data
    """Return the part of pydantic's `loc` that exists in the file.

    Steps that pydantic adds (members of unions, the `value` of a number that inherited its origin) exist
    nowhere.
    """
    steps: list[str | int] = []
    for step in loc:
        inside = isinstance(data, list) and isinstance(step, int) and step < len(data)
        if inside or (isinstance(data, dict) and step in data):
            data = data[step]
            steps.append(step)
    return tuple(steps)


def _known(steps: Steps, model: type[BaseModel]) -> list[str]:
    """Return the keys that may stand at `steps`."""
    shape: FieldType | None = FieldType("document", model=model)
    for step in steps:
        if shape is None:
            break
        shape = fields(shape.model).get(str(step)) if shape.model is not None else shape.item
    return list(fields(shape.model)) if shape is not None and shape.model is not None else []


_WHOLE, _NUMBER, _LIST = (
    "expected a whole number, not {given}",
    "expected a number, not {given}",
    "a list such as [a, b]",
)
_SENTENCES = {
    "string_type": "expected a word, not {given}",
    "string_too_short": "{given} is too short to name anything",
    "int_type": _WHOLE,
    "int_parsing": _WHOLE,
    "int_from_float": _WHOLE,
    "float_type": _NUMBER,
    "float_parsing": _NUMBER,
    "finite_number": _NUMBER,
    "bool_type": "expected `true` or `false`, not {given}",
    "bool_parsing": "expected `true` or `false`, not {given}",
    "list_type": f"expected {_LIST}, not {{given}}",
    "tuple_type": f"expected {_LIST}, not {{given}}",
    "dict_type": "expected keys with values, not {given}",
    "model_type": "expected keys with values, not {given}",
    "too_short": "needs at least {min_length} entries and has {actual_length}",
    "too_long": "has {actual_length} entries; {max_length} are the most",
    "greater_than": "{given} has to be greater than {gt}",
    "greater_than_equal": "{given} has to be {ge} or more",
    "less_than": "{given} has to be less than {lt}",
    "less_than_equal": "{given} has to be {le} or less",
    "value_error": "{error}",
}


def _sentence(detail: ErrorDetails) -> str:
    """Say one finding without pydantic's own words."""
    given, context = detail["input"], detail.get("ctx", {})
    if detail["type"] == "literal_error":
        choices = [part.strip("'") for part in context["expected"].replace(" or ", ", ").split(", ")]
        return f"`{_short(given)}` is not a choice; {suggestion(str(given), choices)}"
    if detail["type"] in _SENTENCES:
        return _SENTENCES[detail["type"]].format(given=f"`{_short(given)}`", **context)
    message = detail["msg"]
    return f"`{_short(given)}`: {message[0].lower()}{message[1:]}"


def _short(given: object, limit: int = 60) -> str:
    text = "nothing" if given is None else str(given)
    return text if len(text) <= limit else f"{text[:limit]}…"
