"""Vehicle stiffness from finite-element histories, by the seed's five steps. Simulates nothing."""

from certkit.documents.extraction import ExtractionResult
from certkit.identification.five_steps import extract
from certkit.identification.vehicle_file import vehicle_text

__all__ = ["ExtractionResult", "extract", "vehicle_text"]
