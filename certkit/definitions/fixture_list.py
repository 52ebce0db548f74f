"""The fixtures that a rig can have, in the order in which the model builds them.

A new fixture is a file in `certkit.definitions.fixtures` and one line here.
"""

from certkit.definitions.channels import ChannelKind
from certkit.definitions.fixtures.fixture import CONTACT_FORCE, Fixture
from certkit.named_class import named_class

_FILES = (
    "hinge",
    "added_mass",
    "stopper",
    "release",
    "hanger",
    "ram",
    "supports",
    "loading_ram",
    "free_flight",
)


FIXTURES: tuple[type[Fixture], ...] = tuple(
    named_class("certkit.definitions.fixtures", file) for file in _FILES
)

RIG_CHANNELS: tuple[ChannelKind, ...] = tuple(
    dict.fromkeys((CONTACT_FORCE, *(kind for fixture in FIXTURES for kind in fixture.channels)))
)
"""What the fixtures measure, whatever legform is on the rig, each once."""
