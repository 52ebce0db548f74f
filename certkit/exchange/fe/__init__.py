"""Finite-element time histories of several solvers, all read into the same `PartHistories`."""

from certkit.exchange.fe.faces import Face, read_faces
from certkit.exchange.fe.histories import (
    ContactHistory,
    PartHistories,
    PartHistory,
    SpringHistory,
    Units,
    parse_units,
)
from certkit.exchange.fe.reading import FrontData, data_folder, read_case_data

__all__ = [
    "ContactHistory",
    "Face",
    "FrontData",
    "PartHistories",
    "PartHistory",
    "SpringHistory",
    "Units",
    "data_folder",
    "parse_units",
    "read_case_data",
    "read_faces",
]
