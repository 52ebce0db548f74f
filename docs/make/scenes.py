"""What is run and what is drawn for the documentation's pictures: the commands a reader would type."""

from __future__ import annotations

RUNS = (
    "certkit run --all --allow not-evaluated --out suite",
    "certkit run --procedure vehicle --set vehicle=generic-saloon --format html --out saloon",
    "certkit extract EXAMPLES/extract/bumper-reference/case.yaml --format html --out bumper",
    "certkit extract EXAMPLES/extract/front1/case.yaml --format html --out front",
    "certkit run --procedure vehicle-fe-front --format html --out lumped-front",
    "certkit compare EXAMPLES/extract/front1/fe-run.csv lumped-front --out compared",
    "certkit study bumper.yaml --out study",
    "certkit campaign EXAMPLES/campaign/suv.yaml --format html --out campaign",
)
"""Run first, in turn, in a folder with the files of `how-to/vehicle.md` and `how-to/study.md`.

`EXAMPLES` stands for the folder of shipped examples.
"""

MOMENTS = "".join(f" --channel {gauge}" for gauge in ("F1", "F2", "F3", "T1", "T2", "T3", "T4"))

FIGURES = {
    "corridors": "certkit figure suite/pendulum/result.json --what corridor",
    "frames": "certkit figure suite/pendulum/result.json --what frames",
    "rig-pendulum": "certkit figure suite/pendulum/result.json --what rig",
    "rig-inverse": "certkit figure suite/inverse/result.json --what rig",
    "rig-static-knee": "certkit figure suite/static-knee/result.json --what rig",
    "energy": "certkit figure suite/pendulum/result.json --what energy",
    "fig-07-femur": "certkit figure suite/static-femur/result.json --what curve",
    "fig-07-tibia": "certkit figure suite/static-tibia/result.json --what curve",
    "fig-10": "certkit figure suite/static-knee/result.json --what curve",
    "fig-13": "certkit figure suite/pendulum/result.json --what history" + MOMENTS,
    "table-1": "certkit figure suite/inverse-seed/result.json --what table",
    "table-1-errors": "certkit figure suite/inverse-seed/result.json --what errors",
    "fig-17": "certkit figure bumper/extraction.json --what momentum",
    "fig-18": "certkit figure bumper/extraction.json --what force",
    "fig-19": "certkit figure bumper/extraction.json --what stiffness",
    "fig-20": "certkit figure bumper/extraction.json --what material",
    "fe-paths": "certkit figure front/extraction.json --what paths",
    "fe-frames": "certkit figure lumped-front/result.json --what frames",
    "fe-table": "certkit figure lumped-front/result.json --what table",
    "saloon-frames": "certkit figure saloon/result.json --what frames",
}
"""Drawn as SVG, by the picture's name."""

TERMINAL = "certkit run --procedure pendulum --format junit --out terminal"
"""Shown as a terminal shows it."""
