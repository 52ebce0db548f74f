"""A rig under construction: the world so far, the leg in it, what fixtures add for channels and motion."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeVar

from msgspec import field

from certkit.definitions.fixtures.rig_builder import GRAVITY, GROUND, LawRow, RigBuilder
from certkit.definitions.fixtures.rig_outlines import PLATE, box, disc
from certkit.documents.rig_motion import Shape
from certkit.errors import RunError
from certkit.mechanics.force_laws import LAWS
from certkit.mechanics.force_laws.law import OutlinePiece
from certkit.mechanics.rig.flesh_layer import flesh_layer, foam_layer

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.definitions.fixtures.rig_builder import Drawn, LegSegment
    from certkit.definitions.fixtures.rig_outlines import Polygon
    from certkit.definitions.legform import Legform
    from certkit.definitions.rig import Rig
    from certkit.definitions.vehicle import Vehicle
    from certkit.mechanics.force_laws.law import ForceLaw
    from certkit.mechanics.legform.leg import Leg
    from certkit.mechanics.records import Floats
    from certkit.mechanics.rig.front_faces import FrontModel
    from certkit.mechanics.rig.recorded_forces import RecordedForce
    from certkit.mechanics.solver.world import Assembly

F = TypeVar("F")

PIN_RADIUS = 0.012
"""m, of a pin; it is drawn only."""


class RigAssembly(RigBuilder, kw_only=True):
    """A rig under construction in a world of bodies and force laws.

    Parameters
    ----------
    assembly, legform, rig, leg
        The world being assembled, and what it is assembled from.
    vehicle : Vehicle, optional
        What is hit.
    contact_law : type of ForceLaw, optional
        Law whose force marks first contact; none where the run starts in contact.
    recorded : dict of str to (law, row, state)
        States of law rows to record at every sample; see `record`.
    moving_shapes : list of (body, Shape)
        Of moving bodies, in the body's axes, for the motion.
    pushed_shapes : list of (Shape, place, reading)
        Of what moves from its place (x, z) towards −x by a recorded travel.
    fixed_shapes : list of Shape
        Of what never moves.
    released_shapes : list of Shape
        Where the leg was let go, before the run begins.
    front : FrontModel, optional
        The vehicle's front.
    driven : sequence of RecordedForce
        Recorded contact forces that press on the leg in the vehicle's place.
    """

    assembly: Assembly
    legform: Legform
    rig: Rig
    leg: Leg
    vehicle: Vehicle | None = None
    contact_law: type[ForceLaw] | None = None
    recorded: dict[str, tuple[type[ForceLaw], int, str]] = field(default_factory=dict)
    moving_shapes: list[tuple[int, Shape]] = field(default_factory=list)
    pushed_shapes: list[tuple[Shape, tuple[float, float], str]] = field(default_factory=list)
    fixed_shapes: list[Shape] = field(default_factory=list)
    released_shapes: list[Shape] = field(default_factory=list)
    front: FrontModel | None = None
    driven: Sequence[RecordedForce] = ()

    def fixture(self, kind: type[F]) -> F | None:
        """Return the fixture of a kind on the same rig, none where it has none."""
        return self.rig.fixture(kind)

    def is_upper(self, end: str) -> bool:
        """Tell whether an end of the leg is the upper one."""
        return self.legform.is_upper(end)

    def bone_face(self, segment: LegSegment) -> float:
        """Return how far a segment's face, or what the flesh on it lies on, stands from the axis, m."""
        inner = self.legform.flesh.face
        return segment.depth / 2 if inner is None or self.cover == 0 else float(inner)

    def flesh_layer(self, cover: float = 0.0) -> dict[str, float]:
        """Return the columns of the layer that a contact law compresses."""
        return flesh_layer(self.legform.flesh, fitted=self.cover > 0, cover=cover)

    def foam_layer(self, cover: float = 0.0) -> dict[str, float] | None:
        """Return the columns of a skinned foam that is fitted; none where the leg wears none."""
        foam = self.legform.flesh.foam
        return None if foam is None or self.cover == 0 else foam_layer(self.assembly, foam, self.cover, cover)

    def set_gravity(self, gravity: float) -> None:
        """Let all bodies weigh: the acceleration along z, m/s²."""
        self.assembly.gravity = (0.0, gravity)

    def add_guided_mass(
        self, name: str, mass: float, place: tuple[float, float], *, speed: float = 0.0, damping: float = 0.0
    ) -> int:
        """Add a body that moves along x only, and return its number."""
        return self.assembly.add_body(
            name, mass, 0.0, (*place, 0.0), speed=(speed, 0.0, 0.0), guided=True, damping=damping
        )

    def pin_end(self, end: str, offset: float, name: str) -> None:
        """Pin the leg to the rig beyond one end, and let its weight pull away from the pin."""
        height = self.beyond(end, offset)
        self.assembly.hinge = self.assembly.add_pivot(self.end_body(end), GROUND, 0.0, height)
        # The rest of the leg is below the pin: for a pinned lower end "down" points to the upper one.
        gravity = -GRAVITY if self.is_upper(end) else GRAVITY
        self.set_gravity(gravity)
        self.up = (0.0, -math.copysign(1.0, gravity))
        base = height + self.up[1] * PIN_RADIUS
        self.draw("ground", "ground", box(-0.12, 0.12, *sorted((base, base + self.up[1] * PLATE))))
        self.draw(name, "rig", disc(0.0, height, PIN_RADIUS))

    def turn(self, angle: float, x: float, z: float) -> None:
        """Turn everything placed so far by an angle (rad) about a point of space."""
        self.assembly.turn(angle, x, z)

    def spin(self, rate: float, x: float, z: float) -> None:
        """Give everything placed so far the speed of a turn (rad/s) about a point of space."""
        self.assembly.spin(rate, x, z)

    def throw(self, x: float, z: float) -> None:
        """Give everything placed so far one velocity, m/s."""
        self.assembly.throw(x, z)

    def masses(self) -> Floats:
        """Return mass (kg), x, z (m) and inertia (kg·m²) of all bodies so far, shape (n, 4)."""
        return self.assembly.masses()

    def add_force(self, law: str, **values: float) -> LawRow:
        """Let a force law act, with its parameters by name."""
        kind = _law(law)
        known = _PARAMETERS[kind]
        if unknown := sorted(set(values) - set(known)):
            said = ", ".join(f"`{name}`" for name in known)
            raise RunError(f"the force law `{law}` has no `{unknown[0]}`; its parameters are {said}")
        return LawRow(law, self.assembly.add(kind(**values)))

    def add_curve(self, points: Sequence[tuple[float, float]]) -> tuple[int, int]:
        """Add a piecewise-linear curve; return its first point and their number."""
        return self.assembly.add_curve(points)

    def mark_contact(self, law: str) -> None:
        """Let time zero be where a law's force first acts."""
        self.contact_law = _law(law)

    def record(self, name: str, row: LawRow, state: str) -> None:
        """Record a state of a law's row at every sample, under a name of its own."""
        self.recorded[name] = (_law(row.law), row.number, state)

    @property
    def has_recorded_forces(self) -> bool:
        """Whether recorded contact forces press on the leg in the vehicle's place."""
        return bool(self.driven)

    def add_recorded_forces(self, ground: float) -> None:
        """Press on the leg with the recorded contact forces."""
        from certkit.mechanics.rig.recorded_forces import press_on_leg  # noqa: PLC0415  # only where there are some

        press_on_leg(self, self.assembly, self.driven, ground)

    def add_vehicle_front(self, ground: float, angle: float) -> None:
        """Put the procedure's vehicle where its front just touches the leg."""
        from certkit.mechanics.rig.vehicle_front import build_front  # noqa: PLC0415  # only where one is hit

        if self.vehicle is None:
            raise RunError("free flight hits a vehicle; name one in the procedure")
        foam = self.legform.flesh.foam
        longest = None if foam is None or foam.element is None or self.cover == 0 else float(foam.element)
        self.front = build_front(self, self.assembly, self.vehicle, ground, angle, longest)

    def draw(self, name: str, kind: Drawn, outline: Polygon, *, note: str = "", body: int = GROUND) -> None:
        """Draw an outline: of a moving body in the body's axes, of what never moves in space."""
        shape = Shape(name=name, kind=kind, outline=outline, note=note)
        if body == GROUND:
            self.fixed_shapes.append(shape)
        else:
            self.moving_shapes.append((body, shape))

    def draw_pushed(
        self, name: str, kind: Drawn, outline: Polygon, *, place: tuple[float, float], by: str, note: str = ""
    ) -> None:
        """Draw what moves from its place (x, z) towards -x by a recorded travel."""
        self.pushed_shapes.append((Shape(name=name, kind=kind, outline=outline, note=note), place, by))

    def draw_before(self, name: str, outline: Polygon, *, note: str = "") -> None:
        """Draw where a piece of the leg was before the run begins."""
        self.released_shapes.append(Shape(name=name, kind="ghost", outline=outline, note=note))

    def add_outline(self) -> None:
        """Tell the world what of the leg obstacles meet: call it when all fixtures stand."""
        last = len(self.leg.segments) - 1
        leg = self.leg
        for i, (segment, body, centre) in enumerate(zip(leg.segments, leg.bodies, leg.centres, strict=True)):
            self.assembly.add_outline(
                OutlinePiece(
                    body=body,
                    top=segment.top - centre + (self.overhang if i == 0 else 0.0),
                    bottom=segment.bottom - centre - (self.overhang if i == last else 0.0),
                    face=self.bone_face(segment),
                    width=self.contact_width.get(segment.part, 0.0),
                )
            )


_LAWS = {law.words(): law for law in LAWS}
_PARAMETERS = {law: law.__struct_fields__ for law in LAWS}


def _law(name: str) -> type[ForceLaw]:
    """Return a force law by its words."""
    if name not in _LAWS:
        raise RunError(f"there is no force law `{name}`; there are {', '.join(_LAWS)}")
    return _LAWS[name]
