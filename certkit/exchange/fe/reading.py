"""Reading what a case names, in whatever format it is, without leaving the folder it lies in."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from certkit.errors import DataError
from certkit.exchange.fe.faces import Face, read_faces
from certkit.exchange.fe.integral import running_integral
from certkit.exchange.fe.node_motion import FOUND_BY_NAME, NodeMotion, read_node_motion
from certkit.exchange.fe.plausible_motion import require_plausible
from certkit.exchange.fe.readers import read_format

if TYPE_CHECKING:
    from certkit.definitions.extraction_case import HistoryFiles
    from certkit.exchange.fe.histories import PartHistories, PartHistory, Values


PLACE, PLACE_SHARE = 1e-3, 0.01
"""m, and share of its range: a displacement that begins with more is a place."""


class FrontData(Struct, frozen=True):
    """Histories of a finite-element run and what is known of its parts' faces and their nodes' motion."""

    histories: PartHistories
    faces: dict[str, Face]
    motion: NodeMotion | None = None


def data_folder(section: HistoryFiles, case_folder: Path) -> Path:
    """Return the folder that the case's histories lie in: its own or one inside it.

    Raises
    ------
    DataError
        When the case names a folder elsewhere.
    """
    return case_folder if section.folder is None else _inside(case_folder, section.folder)


def read_case_data(section: HistoryFiles, folder: Path) -> FrontData:
    """Read all files of a case.

    Parameters
    ----------
    section : HistoryFiles
        What the case says about its files.
    folder : Path
        The folder that the files lie in; nothing outside it is read.

    Raises
    ------
    DataError
        For missing or damaged files, and names that lead out of the folder.
    """
    paths = [_inside(folder, name) for name in section.files]
    histories = read_format(paths, section)
    faces: dict[str, Face] = {}
    digests: dict[str, str] = {}
    if section.table is not None:
        outlines = None if section.outlines is None else _inside(folder, section.outlines)
        faces, digests = read_faces(_inside(folder, section.table), outlines)
    motion, notes = None, histories.notes
    found = _motion_file(section, folder)
    if found is not None:
        motion, digests[str(found)] = read_node_motion(found)
        if section.node_motion is None:
            notes = (*notes, f"the faces' outlines come from the motion of nodes in {found.name}")
    parts = {
        name: _with_momentum(_completed(part, faces.get(name)), histories.time)
        for name, part in histories.parts.items()
    }
    moved_on = [name for name, part in parts.items() if _begins_elsewhere(part)]
    if moved_on:
        parts.update({name: _from_its_start(parts[name]) for name in moved_on})
        named = ", ".join(moved_on)
        notes = (*notes, f"displacements that are not zero at the start count from there: {named}")
    by_velocity = [name for name, part in parts.items() if part.velocity is not None]
    if by_velocity:
        notes = (*notes, f"momenta are masses times velocities: {', '.join(by_velocity)}")
    names = {str(p): n for p, n in zip(paths, section.files, strict=True)}
    files = {
        names.get(path, Path(path).name): digest for path, digest in {**histories.files, **digests}.items()
    }
    histories = replace(histories, parts=parts, files=files, notes=notes)
    require_plausible(histories)
    return FrontData(histories, faces, motion)


def _motion_file(section: HistoryFiles, folder: Path) -> Path | None:
    """Return the table of node motion: the case's, or the one that lies beside the table of groups."""
    if section.node_motion is not None:
        return _inside(folder, section.node_motion)
    if section.table is None:
        return None
    found = sorted(folder.glob(FOUND_BY_NAME))
    return found[0] if len(found) == 1 else None


def _completed(part: PartHistory, face: Face | None) -> PartHistory:
    """Take a part's mass and the place of its centre from the table where its histories do not tell them."""
    if face is None:
        return part
    place = None if face.centre is None else (face.centre[0], None, face.centre[1])
    return replace(
        part,
        mass=face.mass if part.mass is None else part.mass,
        start=place if part.start is None else part.start,
    )


def _with_momentum(part: PartHistory, time: Values) -> PartHistory:
    """Take momentum and displacement from a part's velocity where the file has those not."""
    if part.velocity is None or part.mass is None:
        return part
    moved = running_integral(part.velocity, time)
    return replace(
        part,
        momentum=part.mass * part.velocity,
        displacement=moved if part.displacement is None else part.displacement,
    )


def _begins_elsewhere(part: PartHistory) -> bool:
    """Tell whether a history of displacements begins as one of places would."""
    return any(
        x is not None and abs(float(x[0])) > max(PLACE, PLACE_SHARE * float(np.ptp(x)))
        for x in (part.displacement, part.front)
    )


def _from_its_start(part: PartHistory) -> PartHistory:
    displacement, front = part.displacement, part.front
    return replace(
        part,
        displacement=None if displacement is None else displacement - displacement[0],
        front=None if front is None else front - front[0],
    )


def _inside(folder: Path, name: str) -> Path:
    """Return folder/name, or folder/name.gz where only that exists; refuse names that lead elsewhere."""
    path = folder / name
    if Path(name).is_absolute() or not path.resolve().is_relative_to(folder.resolve()):
        raise DataError(f"{name}: leads out of the case's folder; copy the file into {folder}")
    packed = path.with_name(path.name + ".gz")
    return packed if packed.exists() and not path.exists() else path
