"""The version of certkit, which certificates carry."""

__version__ = "0.2.0.dev0"
