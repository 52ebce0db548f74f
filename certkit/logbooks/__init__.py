"""The logbook of each legform: tests done, validity left and why, where its channels drift."""

from certkit.logbooks.certification import Issue, certificate_of, tests_to_certify
from certkit.logbooks.logbook_store import Logbook, add, rebuild
from certkit.logbooks.overview import overview, shipped_rules

__all__ = [
    "Issue",
    "Logbook",
    "add",
    "certificate_of",
    "overview",
    "rebuild",
    "shipped_rules",
    "tests_to_certify",
]
