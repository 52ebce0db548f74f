"""Frames of a front and a leg in motion: the run's nodes, and the lumped model at the same instants.

The run's lines are its nodes on the middle plane. The model's leg is its chain of segments, its faces are the
outlines that its contact goes by, and what lies inside is the run's first line moved with its group.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from certkit.bench.contact_places import AXIS
from certkit.documents.face_outline import outline_at
from certkit.documents.front_motion import FrontMotion, MovingLine

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from certkit.definitions.legform import Legform
    from certkit.documents.extraction import ExtractionResult, GroupResult
    from certkit.documents.rig_motion import Shape
    from certkit.documents.self_check import ChannelCheck
    from certkit.exchange.fe.node_motion import NodeMotion
    from certkit.mechanics import Simulation
    from certkit.mechanics.records import Floats

    Frames = list[list[tuple[float, float]]]

FRAME = 1e-3
"""s between two frames; longer where there would be more than `MOST_FRAMES`."""
MOST_FRAMES = 61
MOST_POINTS = 24
"""Of one line, thinned evenly."""
REACH = 1.6
"""Two faces meet where the gap between their nodes is below this times the longest piece of the lower one."""
DECIMALS = 5
"""Of a place in m: a hundredth of a millimetre."""


def front_motion(  # noqa: PLR0913  # both sides, and what joins them
    result: ExtractionResult,
    nodes: NodeMotion | None,
    done: Simulation,
    legform: Legform,
    moved: Mapping[str, Floats],
    channels: Sequence[ChannelCheck],
    *,
    time: Floats,
    start: float,
) -> FrontMotion | None:
    """Return the lines of run and model.

    Parameters
    ----------
    result : ExtractionResult
    nodes : NodeMotion, optional
        Without it the run has flat faces that move with their groups, and no leg.
    done : Simulation
        The coupled run.
    legform : Legform
        Its leg.
    moved : mapping of str to ndarray
        Displacement of each group of the model on the axis `time`, m.
    channels : sequence of ChannelCheck
        The leg's channels, for the colours of the leg.
    time : ndarray, shape (n,)
        s from the run's start.
    start : float
        First contact on that axis, s.
    """
    step = max(FRAME, (time[-1] - time[0]) / (MOST_FRAMES - 1))
    instants = time[0] + step * np.arange(int((time[-1] - time[0]) / step + 1e-6) + 1)
    lines = [_leg(nodes, done, legform, result, channels, instants, start)]
    groups = [group for group in result.groups if group.kind != "impactor" and group.name in moved]
    places = {group.name: _nodes(group, nodes) for group in groups}
    faces = {g.name: places[g.name][0] for g in groups if g.position is not None and places[g.name][0]}
    for group in groups:
        own, closed = places[group.name]
        if group.name in faces:
            own = _to_next(own, faces.values())
        lines.append(_group(group, (own, closed), nodes, moved[group.name], time, instants))
    lines = [line for line in lines if line.run or line.model]
    return FrontMotion(times=[round(float(t), 6) for t in instants], lines=tuple(lines)) if lines else None


def _group(
    group: GroupResult,
    line: tuple[list[Floats], bool],
    nodes: NodeMotion | None,
    moved: Floats,
    time: Floats,
    instants: Floats,
) -> MovingLine:
    kind = "inside" if group.position is None else "face"
    places, closed = line
    at = [int(np.searchsorted(time, t - 1e-9)) for t in instants]
    own = group.displacement
    model: Frames = []
    if kind == "face":
        run = _sampled(places, nodes, instants) if len(places) > 1 else _flat(group, [own[i] for i in at])
        if group.outlines:
            most = np.maximum.accumulate(moved)
            model = [[_rounded(p) for p in outline_at(group, float(moved[i]), float(most[i]))] for i in at]
        else:
            model = _flat(group, [float(moved[i]) for i in at])
    else:
        run = _sampled(places, nodes, instants)
        first = run[0] if run else []
        model = [[_rounded((x + float(moved[i]), z)) for x, z in first] for i in at] if first else []
    return MovingLine(name=group.name, kind=kind, closed=closed, run=run, model=model)


def _nodes(group: GroupResult, nodes: NodeMotion | None) -> tuple[list[Floats], bool]:
    """Return a group's nodes in their order along the line, and whether they go around a block."""
    if nodes is None:
        return [], False
    found: list[Floats] = []
    single: list[Floats] = []
    for line, places in nodes.places.items():
        if any(line == part or line.startswith(f"{part}_") for part in group.parts):
            (found if len(places) > 1 else single).extend(places.values())
    if found and group.position is not None:
        return sorted(found, key=lambda p: (float(p[0, 1]), float(p[0, 0]))), False
    if found:
        return _thinned(found), False
    around = _around(single)
    return (around, True) if around else (sorted(single, key=lambda p: float(p[0, 1])), False)


def _to_next(own: list[Floats], faces: Iterable[list[Floats]]) -> list[Floats]:
    """Lead a face on to the first node of the one above, whose nodes its last piece shares."""
    if len(own) < 2:
        return own
    longest = max(math.dist(a[0], b[0]) for a, b in pairwise(own))
    last = own[-1][0]
    above = [face[0] for face in faces if face[0][0, 1] >= last[1] and face[0] is not own[-1]]
    near = min(above, key=lambda node: math.dist(node[0], last), default=None)
    return own if near is None or math.dist(near[0], last) > REACH * longest else [*own, near]


def _around(places: list[Floats]) -> list[Floats]:
    """Return the nodes on the edge of a block, in their order around it; none where they lie on a line."""
    if len(places) < 4:
        return []
    first = np.array([p[0] for p in places])
    low, high = first.min(axis=0), first.max(axis=0)
    if np.min(high - low) < 0.05 * np.max(high - low):
        return []
    edge = np.any((np.abs(first - low) < 1e-4) | (np.abs(first - high) < 1e-4), axis=1)
    middle = 0.5 * (low + high)
    turned = [math.atan2(*(p[0] - middle)[::-1]) for p in places]
    return [places[k] for k in sorted(np.flatnonzero(edge), key=lambda k: turned[k])]


def _thinned(places: list[Floats]) -> list[Floats]:
    if len(places) <= MOST_POINTS:
        return places
    kept = np.unique(np.linspace(0, len(places) - 1, MOST_POINTS).round().astype(int))
    return [places[k] for k in kept]


def _sampled(places: Sequence[Floats], nodes: NodeMotion | None, instants: Floats) -> Frames:
    if nodes is None or len(places) < 2:
        return []
    xz = [[np.interp(instants, nodes.time, p[:, k]) for k in (0, 1)] for p in places]
    return [[_rounded((float(x[f]), float(z[f]))) for x, z in xz] for f in range(instants.size)]


def _flat(group: GroupResult, moved: Sequence[float]) -> Frames:
    """Return a straight face as it moves along x."""
    low, high = group.low or 0.0, group.high or 0.0
    rise = 0.5 * (group.slope or 0.0) * (high - low)
    x = group.position or 0.0
    return [[_rounded((x - rise + d, low)), _rounded((x + rise + d, high))] for d in moved]


def _leg(
    nodes: NodeMotion | None,
    done: Simulation,
    legform: Legform,
    result: ExtractionResult,
    channels: Sequence[ChannelCheck],
    instants: Floats,
    start: float,
) -> MovingLine:
    axis = [
        p for line, q in (nodes.places if nodes else {}).items() if line.startswith(AXIS) for p in q.values()
    ]
    run = _sampled(_thinned(sorted(axis, key=lambda p: float(p[0, 1]))), nodes, instants)
    model, heights = _model_leg(done, result, instants, start)
    gauges = {
        c.name: legform.gauge_height(legform.channels[c.name]) for c in channels if _bends(legform, c.name)
    }
    run_moments: list[list[float]] = []
    if run:
        bottom = heights[0]
        own = [z - run[0][0][1] + bottom for _, z in run[0]]
        run_moments = _moments(legform, channels, gauges, own, instants, of_run=True)
    return MovingLine(
        name="leg",
        kind="leg",
        run=run,
        model=model,
        run_moments=run_moments,
        model_moments=_moments(legform, channels, gauges, heights, instants, of_run=False),
    )


def _model_leg(
    done: Simulation, result: ExtractionResult, instants: Floats, start: float
) -> tuple[Frames, list[float]]:
    """Return the model's axis in the run's place, and its points' heights above the knee centre at first."""
    motion = done.motion
    bones = [k for k, shape in enumerate(motion.shapes) if shape.kind in {"bone", "knee"}][::-1]
    shift = _shift(motion.shapes, motion.poses[0], result)
    ground = max(z for shape in motion.scene if shape.kind == "ground" for _, z in shape.outline)
    ends = [_ends(motion.shapes[k]) for k in bones]
    frames = []
    for pose in motion.poses:
        points = [_placed(low, pose[k]) for k, (low, _) in zip(bones, ends, strict=True)]
        points.append(_placed(ends[-1][1], pose[bones[-1]]))
        frames.append(points)
    table = np.array(frames)
    heights = [float(z) for z in table[0, :, 1]]
    own = np.array(motion.times) + start
    sampled = np.stack(
        [[np.interp(instants, own, table[:, p, k]) for k in (0, 1)] for p in range(table.shape[1])]
    )
    moved = sampled - np.array([shift, ground])[None, :, None]
    # Before first contact the leg flies freely: along the line of its first two frames.
    early = instants < own[0]
    if early.any():
        speed = (table[1] - table[0]) / (own[1] - own[0])
        moved[:, :, early] += speed[:, :, None] * (instants[early] - own[0])[None, None, :]
    count = instants.size
    return [[_rounded((float(x[f]), float(z[f]))) for x, z in moved] for f in range(count)], heights


def _shift(
    shapes: Sequence[Shape], pose: Sequence[tuple[float, float, float]], result: ExtractionResult
) -> float:
    """Return by how much the model's front stands further along x than its document."""
    groups = {group.name: group for group in result.groups}
    for shape, (x, _, _) in zip(shapes, pose, strict=True):
        group = groups.get(shape.name)
        if shape.kind == "vehicle" and group is not None and group.position is not None:
            rise = 0.5 * (group.slope or 0.0) * ((group.high or 0.0) - (group.low or 0.0))
            return x + shape.outline[0][0] - (group.position - rise)
    return 0.0


def _ends(shape: Shape) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the lower and the upper end of a segment's axis in its own frame."""
    xs, zs = zip(*shape.outline, strict=True)
    middle = 0.5 * (min(xs) + max(xs))
    return (middle, min(zs)), (middle, max(zs))


def _placed(point: tuple[float, float], pose: tuple[float, float, float]) -> tuple[float, float]:
    c, s = math.cos(pose[2]), math.sin(pose[2])
    return pose[0] + c * point[0] - s * point[1], pose[1] + s * point[0] + c * point[1]


def _bends(legform: Legform, name: str) -> bool:
    channel = legform.channels.get(name)
    return channel is not None and channel.measures == "bending moment"


def _moments(
    legform: Legform,
    channels: Sequence[ChannelCheck],
    gauges: Mapping[str, float],
    heights: Sequence[float],
    instants: Floats,
    *,
    of_run: bool,
) -> list[list[float]]:
    """Return the moment in each piece, N·m, linear between gauges and zero at both ends."""
    timed = [c for c in channels if c.name in gauges and c.start is not None and c.interval is not None]
    if not timed:
        return []
    ends = (legform.span(legform.chain[0])[0], legform.span(legform.chain[-1])[1])
    known: list[tuple[float, Floats]] = [(end, np.zeros_like(instants)) for end in ends]
    for check in timed:
        values = check.run_values if of_run else check.values
        axis = (check.start or 0.0) + (check.interval or 0.0) * np.arange(len(values))
        known.append((gauges[check.name], np.interp(instants, axis, values, left=0.0)))
    known.sort(key=lambda gauge: gauge[0])
    at, table = [height for height, _ in known], np.array([values for _, values in known])
    middles = [0.5 * (low + high) for low, high in pairwise(heights)]
    return [[round(float(v), 1) for v in np.interp(middles, at, table[:, f])] for f in range(instants.size)]


def _rounded(point: tuple[float, float]) -> tuple[float, float]:
    return round(point[0], DECIMALS) + 0.0, round(point[1], DECIMALS) + 0.0
