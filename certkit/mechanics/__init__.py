"""The planar world on pymunk: time loop, force laws, legform builder, rig fixtures, quality figures.

`simulate` is the way in. Importing this room imports pymunk, so it is imported where it is used.
"""

from certkit.mechanics.outputs.energy_balance import RunQuality
from certkit.mechanics.outputs.motion import Figure, RecordedMotion
from certkit.mechanics.simulate import Simulation, simulate

__all__ = ["Figure", "RecordedMotion", "RunQuality", "Simulation", "simulate"]
