"""The logbook of each legform: tests done, validity left and why, where its channels drift."""

from certkit.logbook.logbook_store import Logbook, add, rebuild
from certkit.logbook.overview import overview

__all__ = ["Logbook", "add", "overview", "rebuild"]
