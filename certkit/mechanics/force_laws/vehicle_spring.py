"""A spring between two groups of a vehicle, or a group and the ground, along x.

Piecewise-linear loading curve; unloading and reloading on a branch of their own with residual force and
permanent set; a pulling side with a memory of its own; a damper. The same law as
`identification.spring_law`, which says it in formulas; a test holds the two together. The points of all
curves stand in one table that springs point into.
"""

from __future__ import annotations

from certkit.mechanics.force_laws.law import POWER, SPENT, STORED, Floats, Integers, Law, Scene, X
from certkit.mechanics.solver.compiling import compiled

POINTS = Law("loading curves", (), ("shortening", "force"), ())
LAW = Law(
    "vehicle springs",
    ("first", "second"),
    (
        "rest",
        "push from",
        "push points",
        "pull from",
        "pull points",
        "unloading",
        "residual",
        "permanent set",
        "damping",
    ),
    ("longest push", "longest pull", "shortening", "force", "spring", "stored"),
)


@compiled
def _curve(points: Floats, start: int, count: int, x: float) -> float:
    """Return the force at x ≥ 0, continued with the last slope, but never with a falling one."""
    low, high = start, start + count - 1
    if x >= points[high, 0]:
        slope = (points[high, 1] - points[high - 1, 1]) / (points[high, 0] - points[high - 1, 0])
        return float(points[high, 1] + max(slope, 0.0) * (x - points[high, 0]))
    while high - low > 1:
        middle = (low + high) // 2
        if x < points[middle, 0]:
            high = middle
        else:
            low = middle
    share = (x - points[low, 0]) / (points[high, 0] - points[low, 0])
    return float(points[low, 1] + share * (points[high, 1] - points[low, 1]))


@compiled
def _side(
    points: Floats, start: int, count: int, x: float, top: float, branch: Floats
) -> tuple[float, float]:
    """Return force and recoverable energy of one side at x ≥ 0, whose largest value so far is `top`."""
    unloading, residual, rest = branch[0], branch[1], branch[2] * top
    peak = _curve(points, start, count, top)
    steep = max(peak - unloading * (top - x), 0.0)
    flat = residual * peak / (top - rest) if top > rest else 0.0
    soft = flat * max(x - rest, 0.0)
    force = peak if x >= top else min(max(steep, soft), _curve(points, start, count, x))
    # Area under the branch: the flat part from the permanent set, and what the steep part stands above it.
    stored = 0.5 * soft * max(x - rest, 0.0)
    above = steep - soft
    if above > 0.0 and unloading > flat:
        foot = x - above / (unloading - flat)
        if foot < rest:  # the steep part meets zero before the flat one begins
            stored = 0.5 * steep * steep / unloading
        else:
            stored = 0.5 * flat * (foot - rest) * (foot - rest) + 0.5 * (steep + flat * (foot - rest)) * (
                x - foot
            )
    return force, stored


@compiled
def stretch(
    index: Integers,
    number: Floats,
    state: Floats,
    points: Floats,
    scene: Scene,
    load: Floats,
    ledger: Floats,
) -> None:
    """Add the springs' forces; see `certkit.mechanics.force_laws.law`."""
    pose, rate = scene.pose, scene.rate
    for i in range(index.shape[0]):
        first, second = index[i, 0], index[i, 1]
        x = pose[first, X] - pose[second, X] - number[i, 0]
        v = rate[first, 0] - rate[second, 0]
        branch = number[i, 5:8]
        start, count = int(number[i, 1]), int(number[i, 2])
        pushed = max(x, 0.0)
        top = max(state[i, 0], pushed)
        spring, stored = _side(points, start, count, pushed, top, branch)
        pulls = number[i, 4] > 0.0
        longest = state[i, 1]
        if pulls:
            # The pulling side starts from the length that the shortening has left behind.
            if branch[1] > 0.0:
                length = branch[2] * top
            else:
                length = max(top - _curve(points, start, count, top) / branch[0], 0.0)
            y = length - x
            if y > 0.0:
                longest = max(longest, y)
                pull, energy = _side(points, int(number[i, 3]), int(number[i, 4]), y, longest, branch)
                spring, stored = -pull, stored + energy
        damper = number[i, 8] * v
        if not pulls:
            damper = max(damper, -spring) if spring > 0.0 else 0.0
        work = 0.5 * (spring + state[i, 4]) * (x - state[i, 2])
        ledger[SPENT] += work - (stored - state[i, 5])
        ledger[STORED] += stored
        ledger[POWER] += damper * v
        force = spring + damper
        load[first, 0] -= force
        load[second, 0] += force
        state[i, 0] = top
        state[i, 1] = longest
        state[i, 2] = x
        state[i, 3] = force
        state[i, 4] = spring
        state[i, 5] = stored
