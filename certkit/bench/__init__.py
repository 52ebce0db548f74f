"""The bench: the one place where the rooms meet. `run` a simulated test, `grade` a measured one, `compare` two."""







__all__ = ["Setup", "grade", "prepare", "run", "run_family", "save"]
