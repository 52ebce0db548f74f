"""Vehicle stiffness from finite-element histories, by the seed's five steps. Simulates nothing."""

from certkit.identification.extract import extract
from certkit.identification.result import ExtractionResult
from certkit.identification.vehicle_file import vehicle_text

__all__ = ["ExtractionResult", "extract", "vehicle_text"]
