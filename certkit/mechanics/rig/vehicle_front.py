"""The front of a vehicle on the rig: guided groups, the faces that the leg meets, springs between them.

Heights are the vehicle document's, above the ground, less the height of the knee centre.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from certkit.definitions.fixtures.rig_builder import LawRow
from certkit.definitions.fixtures.rig_outlines import PLATE, box
from certkit.errors import RunError
from certkit.mechanics.rig.face_outlines import OutlineStrip, outline_strips
from certkit.mechanics.rig.front_faces import FrontModel, face_strips
from certkit.mechanics.rig.front_groups import add_groups
from certkit.mechanics.rig.recorded_tables import add_path

if TYPE_CHECKING:
    from certkit.definitions.fixtures.rig_builder import RigBuilder
    from certkit.definitions.vehicle import Group, Vehicle
    from certkit.mechanics.rig.front_faces import FrontStrip
    from certkit.mechanics.solver.world import Assembly

SLAB = 0.012
"""m: thickness of a face as it is drawn."""


UNMOVED = (np.zeros(1), np.zeros((1, 3)))
"""A way back that adds nothing."""


class _Front(NamedTuple):
    """Bodies of a front's groups by name, friction of its faces, and the leg's foam if it wears one."""

    bodies: dict[str, int]
    friction: float
    foam: dict[str, float] | None


def build_front(
    rig: RigBuilder,
    assembly: Assembly,
    vehicle: Vehicle,
    ground: float,
    angle: float,
    longest: float | None,
) -> FrontModel:
    """Build a vehicle's front where it just touches the leg; return what was built.

    The leg has been turned and thrown already; see `RigBuilder.add_vehicle_front`. Faces are met
    in strips of a `longest` length (m), of their own where that is None.
    """
    folding = outline_strips(vehicle, ground, longest)
    strips = [] if folding else face_strips(vehicle, ground, longest)
    start = _touching(rig, [(s.x, s.z) for s in strips] + [s.start for s in folding], angle)
    bodies, links = add_groups(assembly, vehicle, ground)
    front = _Front(bodies, float(vehicle.friction or 0.0), rig.foam_layer())
    _add_faces(rig, assembly, strips, start, front)
    _add_folding_faces(rig, assembly, folding, start, front)
    for link in links:
        for state in ("shortening", "force"):
            rig.record(f"spring {link.name} {state}", LawRow(link.law.words(), link.row), state)
    bare = "folding face contact" if folding else "vehicle front contact"
    rig.mark_contact(bare if front.foam is None else "skinned foam contact")
    rig.longest_approach = 0.01
    rig.draw("ground", "ground", box(-0.3, 0.5, ground - PLATE, ground))
    for name, group in vehicle.groups.items():
        _draw_face(rig, bodies[name], assembly.centre(bodies[name]), name, group, start, ground)
    names = tuple(link.name for link in links)
    return FrontModel(bodies, tuple(strips), names, tuple((s.group, s.partner, s.share) for s in folding))


def _touching(rig: RigBuilder, places: list[tuple[float, float]], angle: float) -> float:
    """Return by how much the front has to be moved along x so that it just touches the leg."""
    gaps = []
    tangent, cosine = math.tan(angle), math.cos(angle)
    for x, z in places:
        height = z / cosine
        for segment in rig.leg.segments:
            if segment.bottom <= height <= segment.top:
                face = -z * tangent + (rig.bone_face(segment) + rig.cover) / cosine
                gaps.append(x - face)
                break
    if not gaps:
        raise RunError(
            "the leg flies past the front without touching it; check the faces' heights and the flight's"
        )
    return -min(gaps)


def _add_faces(
    rig: RigBuilder, assembly: Assembly, strips: list[FrontStrip], start: float, front: _Front
) -> None:
    """Let the leg's flesh meet the strips, which stand `start` (m) further along x than their document."""
    layer = rig.flesh_layer() if front.foam is None else {}
    for number, strip in enumerate(strips):
        lower, upper = (front.bodies[name] for name in (strip.lower, strip.upper))
        moved = (1 - strip.share) * assembly.centre(lower)[0] + strip.share * assembly.centre(upper)[0]
        shares = {"lower": lower, "upper": upper, "share": strip.share, "friction": front.friction}
        if front.foam is None:
            row = rig.add_force(
                "vehicle front contact",
                face_x=strip.x + start - moved,
                face_z=strip.z,
                height=strip.height,
                thickness=rig.cover,
                **shares,
                **layer,
            )
        else:
            place = np.zeros(1), np.array([[strip.x + start, strip.z, strip.height]])
            path = add_path(assembly, place, UNMOVED)
            row = rig.add_force(
                "skinned foam contact",
                load_share=strip.share,
                rest=moved,
                order=number,
                **shares,
                **front.foam,
                **path,
            )
        rig.record(f"strip {number} force", row, "force")


def _add_folding_faces(
    rig: RigBuilder, assembly: Assembly, strips: list[OutlineStrip], start: float, front: _Front
) -> None:
    """Let the leg's flesh meet faces that fold, which stand `start` (m) further along x."""
    layer = rig.flesh_layer() if front.foam is None else {}
    for number, strip in enumerate(strips):
        pushed = strip.pushed + np.array([start, 0.0, 0.0])
        group, partner = front.bodies[strip.group], front.bodies[strip.partner]
        folding = {
            "rest": assembly.centre(group)[0],
            "friction": front.friction,
            "order": number,
            **add_path(assembly, (strip.at, pushed), (strip.shares, strip.back)),
        }
        if front.foam is None:
            row = rig.add_force(
                "folding face contact",
                group=group,
                partner=partner,
                share=strip.share,
                thickness=rig.cover,
                **layer,
                **folding,
            )
        else:
            row = rig.add_force(
                "skinned foam contact",
                lower=group,
                upper=partner,
                share=0.0,
                load_share=strip.share,
                **front.foam,
                **folding,
            )
        rig.record(f"folding strip {number} force", row, "force")


def _draw_face(
    rig: RigBuilder, body: int, centre: tuple[float, float], name: str, group: Group, x: float, ground: float
) -> None:
    """Draw a group's face, `x` (m) further along than its document, as a thin slab in the body's frame."""
    if group.low is None or group.high is None:
        return
    low, high = float(group.low), float(group.high)
    middle, x = 0.5 * (low + high), float(group.position or 0.0) + x
    slope = float(group.slope or 0.0)
    ends = [(x + slope * (z - middle) - centre[0], z + ground - centre[1]) for z in (low, high)]
    outline = [*ends, *((px + SLAB, pz) for px, pz in reversed(ends))]
    rig.draw(name, "vehicle", outline, body=body)
