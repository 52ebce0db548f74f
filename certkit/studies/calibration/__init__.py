"""Calibration: fit the free numbers of a leg to its tests, and say how well they are known."""
