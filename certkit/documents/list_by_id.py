"""A list whose parts are found by their id as well: `result.criteria["T1"]`."""

from __future__ import annotations

from types import GenericAlias
from typing import TYPE_CHECKING, Any, Generic, Protocol, SupportsIndex, TypeVar, get_args, overload

from pydantic_core import core_schema

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler


class Identified(Protocol):
    """A part with an id."""

    @property
    def id(self) -> str:
        """Its id."""


T = TypeVar("T", bound=Identified)


class ListById(list[T], Generic[T]):
    """A list of parts with ids, in the order of the document; in JSON a plain list."""

    @overload
    def __getitem__(self, key: str | SupportsIndex, /) -> T: ...
    @overload
    def __getitem__(self, key: slice, /) -> list[T]: ...
    def __getitem__(self, key: str | SupportsIndex | slice, /) -> T | list[T]:
        """Return a part by its id or place, or some by their places.

        Raises
        ------
        KeyError
            When no part has the id; names those that there are.
        """
        if not isinstance(key, str):
            return super().__getitem__(key)
        for part in self:
            if part.id == key:
                return part
        raise KeyError(f"there is no `{key}`; there are {', '.join(self.ids)}")

    def __contains__(self, key: object, /) -> bool:
        """Tell whether a part, or one with this id, is among them."""
        return key in self.ids if isinstance(key, str) else super().__contains__(key)

    @property
    def ids(self) -> list[str]:
        """The ids, in order."""
        return [part.id for part in self]

    @classmethod
    def __get_pydantic_core_schema__(
        cls,
        source: Any,  # noqa: ANN401  # pydantic's own signature
        handler: GetCoreSchemaHandler,
    ) -> core_schema.CoreSchema:
        """Read and write it as the list that it is."""
        plain = GenericAlias(list, get_args(source))
        return core_schema.no_info_after_validator_function(cls, handler(plain))
