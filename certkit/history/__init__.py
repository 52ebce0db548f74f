"""The logbook of each legform: tests done, validity left and why, where its channels drift."""

from certkit.history.logbook import Logbook, add, rebuild
from certkit.history.overview import overview

__all__ = ["Logbook", "add", "overview", "rebuild"]
