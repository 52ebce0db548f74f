"""certkit: a regulatory certification bench for the Flex-PLI legform."""

from certkit._version import __version__

__all__ = ["__version__"]
