"""The solver: the time loop, its compiled kernel, and the pymunk space that it steps."""
