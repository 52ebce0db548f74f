"""The logbook of each legform: tests done, validity left and why, where its channels drift."""

from certkit.logbooks.logbook_store import Logbook, add, rebuild
from certkit.logbooks.overview import overview, shipped_rules

__all__ = ["Logbook", "add", "overview", "rebuild", "shipped_rules"]
