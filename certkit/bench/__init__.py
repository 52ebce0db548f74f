"""The bench: the only room that orchestrates; one file for each thing that `certkit` offers to do.

`certkit.run`, `grade`, `compare`, `verify`, `extract`, `export`, `logbook`, `render` and `load` are functions
of the files here; import them from `certkit`, or each from its file.
"""
