"""A fit from its task to its files."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from certkit.files import write_whole
from certkit.reporting.plaintext import aligned
from certkit.studies.calibration.fit import calibrate, runs_for
from certkit.studies.calibration.fitted_files import report, write_family, write_fit
from certkit.studies.calibration.leg_family import kin
from certkit.studies.study_pages import fit_page

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.studies.calibration.fit import Calibration, Task
    from certkit.studies.calibration.search import Tell

JOURNAL = "runs.jsonl"


def carry_and_write(
    task: Task,
    folder: Path,
    *,
    family: int | None = None,
    processes: int | None = None,
    cluster: str | None = None,
    tell: Tell = lambda _: None,
) -> tuple[list[Path], str, str]:
    """Calibrate, find relatives where wanted, and write everything.

    Returns
    -------
    list of Path
        Files written: the legform, rigs that were fitted, `fit.json`, `fit.html`, `families/LEGFORM.yaml`.
    str
        The report as JSON text.
    str
        The report in a few lines.
    """
    found, paths = fit_and_write(task, folder, family=family, processes=processes, cluster=cluster, tell=tell)
    data = report(found)
    return paths, json.dumps(data, ensure_ascii=False, indent=1, allow_nan=False) + "\n", summary(data)


def fit_and_write(
    task: Task,
    folder: Path,
    *,
    family: int | None = None,
    processes: int | None = None,
    cluster: str | None = None,
    tell: Tell = lambda _: None,
) -> tuple[Calibration, list[Path]]:
    """Calibrate and write; return what was found and the files, as `carry_and_write`."""
    with runs_for(task, journal=folder / JOURNAL, processes=processes, cluster=cluster) as runs:
        found = calibrate(task, runs, tell)
        paths = write_fit(found, folder)
        paths.append(folder / "fit.html")
        write_whole(paths[-1], fit_page(report(found)))
        if family:
            members = kin(found, runs, family, tell)
            paths.append(folder / "families" / f"{task.sheet.legform}.yaml")
            write_family(found, members, paths[-1])
    return found, paths


def summary(data: dict[str, Any]) -> str:
    """Return the values before and after, and how well the parameters are known, for a terminal."""
    heads = ("value", "should be", "before", "after", "unit", "distance")
    rows = [
        (
            str(v["name"]),
            f"{v['aim']:.4g}",
            _figure(v["before"]),
            _figure(v["after"]),
            str(v["unit"]),
            f"{v['distance_after']:+.2f}",
        )
        for v in data["values"]
    ]
    open_ones = [p["name"] for p in data["parameters"] if not p["determined"]]
    lines = [
        aligned(heads, rows, right=(1, 2, 3, 5)),
        f"rms distance {data['rms_before']:.3f} before, {data['rms_after']:.3f} after ({data['runs']} runs)",
        "every graded criterion passes" if data["passes"] else "not every graded criterion passes",
    ]
    if open_ones:
        lines.append(f"not determined by these tests: {', '.join(open_ones)}")
    return "\n".join(lines)


def _figure(value: float | str | None) -> str:
    return f"{value:.4g}" if isinstance(value, float) else "–"
