"""The motion of a front's nodes held against its histories: one run, one clock, one unit, one place.

The nodes of a part move in the mean about as its front does (within a few per cent on the middle line of a
front as wide as a car), and stand at the start where its face stands. Where they do something quite
different, units, signs or clocks are confused; where they only do something else, one of them may be of
another run.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from certkit.errors import DataError
from certkit.exchange.fe.plausible_motion import CONFUSED, OPPOSITE

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from certkit.exchange.fe.faces import Face
    from certkit.exchange.fe.histories import PartHistories, PartHistory, Values
    from certkit.exchange.fe.node_motion import NodeMotion

MOVES = 0.1
"""Share of the largest movement of a face below which a face's own is not judged."""

ALIKE = 2.0
LEAST_CORRELATION = 0.9
"""A clock that is a tenth of the impact off correlates less."""

COVERED = 0.1
"""Share of the histories' span: nodes that tell less are told in another unit of time."""

ENDS_EARLY = 0.1
"""Share of the histories' span that may lack at its end."""


class _FaceMovement(NamedTuple):
    """A part's largest movement by its nodes and by its history, m, and how well their courses correlate."""

    part: str
    nodes: float
    history: float
    course: float


def require_same_run(motion: NodeMotion, histories: PartHistories, faces: Mapping[str, Face]) -> None:
    """Refuse nodes that cannot be of the histories' run.

    Raises
    ------
    DataError
        With the part, both figures and what to look at.
    """
    begin, span = float(histories.time[0]), float(histories.time[-1] - histories.time[0])
    if float(motion.time[-1]) - begin < COVERED * span:
        raise DataError(
            f"{motion.source}: the histories last {1e3 * span:.4g} ms, the motion of the nodes ends at "
            f"{1e3 * float(motion.time[-1]):.4g} ms; correct the unit of its times, or export it again"
        )
    for part, nodes, told, course in _held(motion, histories, faces):
        turned = course < OPPOSITE and 1 / ALIKE <= nodes / told <= ALIKE
        if turned or not 1 / CONFUSED < nodes / told < CONFUSED:
            raise DataError(
                f"{motion.source}: the front of part `{part}` moves by {1e3 * told:.4g} mm, its nodes by "
                f"{1e3 * nodes:.4g} mm{', the other way' if turned else ''}; check units and signs of "
                "both, and that the nodes' places are given, not their displacements"
            )
    apart = [part for part, _, _ in _beside_their_faces(motion, faces)]
    if apart and len(apart) == sum(part in motion.places for part in faces if _has_face(faces[part])):
        raise DataError(
            f"{motion.source}: no node stands at the height of its part's face (`{apart[0]}` …); check "
            "units and origin of the nodes' places and of the table of groups"
        )


def node_remarks(motion: NodeMotion, histories: PartHistories, faces: Mapping[str, Face]) -> list[str]:
    """Return what speaks against the nodes without ruling them out."""
    said = []
    end, last = float(motion.time[-1]), float(histories.time[-1])
    if last - end > ENDS_EARLY * (last - float(histories.time[0])):
        said.append(
            f"the motion of the nodes ends at {1e3 * end:.4g} ms, the histories at {1e3 * last:.4g} ms: what "
            "form the faces have later is not known; export the nodes as long"
        )
    bare = [part for part, face in faces.items() if _has_face(face) and part not in motion.places]
    if bare:
        named = ", ".join(f"`{part}`" for part in bare)
        said.append(f"the motion of the nodes has none of {named}: such a face stays flat")
    unlike = [
        f"`{part}` ({1e3 * nodes:.4g} and {1e3 * told:.4g} mm, correlation {course:.2f})"
        for part, nodes, told, course in _held(motion, histories, faces)
        if course < LEAST_CORRELATION or not 1 / ALIKE < nodes / told < ALIKE
    ]
    if unlike:
        said.append(
            f"the nodes of a part and its front move unlike each other: {', '.join(unlike)}; are both of one "
            "run, on one clock?"
        )
    said += [
        f"part `{part}`: its nodes begin {1e3 * low:.4g} to {1e3 * high:.4g} mm above the ground, where its "
        "face is not; is the table of groups that of this run?"
        for part, low, high in _beside_their_faces(motion, faces)
    ]
    return said


def _has_face(face: Face) -> bool:
    return face.low is not None and face.high is not None


def _held(motion: NodeMotion, histories: PartHistories, faces: Mapping[str, Face]) -> Iterator[_FaceMovement]:
    """Yield the faces that move, by their nodes and by their histories."""
    fronts = {
        part: _moved(histories.parts[part])
        for part, face in faces.items()
        if _has_face(face) and part in motion.places and part in histories.parts
    }
    largest = max((float(np.abs(x).max()) for x in fronts.values() if x is not None), default=0.0)
    seen = histories.time <= float(motion.time[-1])
    for part, whole in fronts.items():
        told = np.zeros(1) if whole is None else whole[seen]
        if float(np.abs(told).max()) <= MOVES * largest:
            continue
        nodes = np.mean([place[:, 0] - place[0, 0] for place in motion.places[part].values()], axis=0)
        own = np.interp(histories.time[seen], motion.time, nodes)
        course = float(np.corrcoef(own, told)[0, 1]) if min(np.ptp(own), np.ptp(told)) > 0 else 0.0
        yield _FaceMovement(part, float(np.abs(own).max()), float(np.abs(told).max()), course)


def _moved(part: PartHistory) -> Values | None:
    return part.displacement if part.front is None else part.front


def _beside_their_faces(motion: NodeMotion, faces: Mapping[str, Face]) -> Iterator[tuple[str, float, float]]:
    """Yield the parts whose nodes all begin above or below their face, and between which heights, m."""
    for part, face in faces.items():
        if face.low is None or face.high is None or part not in motion.places:
            continue
        heights = [float(place[0, 1]) for place in motion.places[part].values()]
        if min(heights) > face.high or max(heights) < face.low:
            yield part, min(heights), max(heights)
