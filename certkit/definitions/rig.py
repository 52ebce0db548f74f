"""The rig of a procedure: any combination of the fixtures in `certkit.definitions.fixtures`."""

from typing import TYPE_CHECKING, Any, TypeVar

from pydantic import create_model

from certkit.definitions.base import Section
from certkit.definitions.fixture_list import FIXTURES
from certkit.definitions.fixtures.fixture import Fixture, TestKind

F = TypeVar("F")


class RigBase(Section):
    """What a rig can be asked; `Rig` adds one field for each fixture."""

    def fixtures(self) -> list[Fixture]:
        """Return the fixtures on it, in the order in which the model builds them."""
        found = [getattr(self, kind.field_name()) for kind in FIXTURES]
        return [fixture for fixture in found if fixture is not None]

    def fixture(self, kind: type[F]) -> F | None:
        """Return its fixture of a kind, none where it has none."""
        return next((found for found in self.fixtures() if isinstance(found, kind)), None)

    @property
    def test_kind(self) -> TestKind:
        """Return what its fixtures make of the test; `dynamic` where none says otherwise."""
        kinds = {fixture.test_kind for fixture in self.fixtures()}
        return "flight" if "flight" in kinds else "static" if "static" in kinds else "dynamic"


if TYPE_CHECKING:
    Rig = RigBase
else:
    _FIELDS: dict[str, Any] = {kind.field_name(): (kind | None, None) for kind in FIXTURES}
    Rig = create_model(
        "Rig",
        __base__=RigBase,
        __doc__="All fixtures that certkit knows; a procedure names those it needs.",
        __module__=__name__,
        **_FIELDS,
    )
