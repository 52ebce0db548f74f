"""The sleeve of flesh that bends beside a bone's joint; no gauge feels it.

Given by its own stiffness and damping time, it is a rotational spring and damper. Given as a foam under a
skin, each layer is strained in proportion to its distance from the bone's axis, which the bone keeps from
being stretched: the skin's bending stiffness is E·b·t·y² at the distance y of the foam's outer face, the
foam's the curve's first slope times b·(y₂³ - y₁³)/3 between its two faces, the far side's a share of that.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.force_laws.foam_sleeve import FoamSleeve
from certkit.mechanics.force_laws.joint_spring import JointSpring

if TYPE_CHECKING:
    from certkit.definitions.legform_parts import Flesh
    from certkit.mechanics.solver.world import Assembly


def add_sleeve(
    assembly: Assembly, flesh: Flesh, bodies: tuple[int, int], curvature: float, face: float
) -> None:
    """Let the sleeve bend beside the joint of two bodies, if the flesh has one.

    Parameters
    ----------
    assembly : Assembly
    flesh : Flesh
    bodies : tuple of int
        The upper and the lower one.
    curvature : float
        For a joint angle of one, 1/m.
    face : float
        Distance of the flesh's bone side from the axis, m, where the flesh names none.
    """
    upper, lower = bodies
    if flesh.bending_stiffness is not None:
        stiffness = curvature * flesh.bending_stiffness
        assembly.add(
            JointSpring(
                upper=upper,
                lower=lower,
                stiffness=stiffness,
                damping=stiffness * (flesh.damping_time or 0.0),
            )
        )
    foam = flesh.foam
    if foam is None or foam.elastic_modulus is None:
        return
    inner = face if flesh.face is None else float(flesh.face)
    outer = inner + float(flesh.thickness)
    far = 0.0 if flesh.far_side is None else float(flesh.far_side.foam or 0.0)
    layers = (1.0 + far) * float(foam.width) * (outer**3 - inner**3) / 3.0
    skin = float(foam.skin_modulus) * float(foam.width) * float(foam.skin_thickness) * outer**2
    assembly.add(
        FoamSleeve(
            upper=upper,
            lower=lower,
            skin=curvature * skin,
            foam=curvature * foam.first_modulus * layers,
            elastic=curvature * float(foam.elastic_modulus) * layers,
            hysteresis=float(foam.hysteresis),
        )
    )
