"""The planar model on pymunk: legform, rig, force laws, solver, and what a run yields.

`simulate` is the way in. Importing this room imports pymunk, so it is imported where it is used.
"""

from certkit.mechanics.outputs.energy_balance import RunQuality
from certkit.mechanics.simulate import Simulation, simulate

__all__ = ["RunQuality", "Simulation", "simulate"]
