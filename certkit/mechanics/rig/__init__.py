"""A rig under construction, as fixtures build themselves with it, and the front of a vehicle on it."""
