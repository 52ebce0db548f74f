"""Many runs: sweeps, sensitivity, scatter, optimisation, calibration and the family of legs."""
