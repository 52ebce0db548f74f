"""How much of the leg's channels hangs on where the contact forces act: the leg alone, all of them moved."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec.structs import replace

from certkit.bench.channel_checks import channel_checks
from certkit.bench.checked_run import CheckedRun
from certkit.bench.contact_places import recorded_forces
from certkit.bench.extract_vehicle import PROCEDURE
from certkit.bench.setup import prepare
from certkit.definitions.loading.library import load
from certkit.definitions.loading.search_path import shipped_root
from certkit.exchange.fe import read_case_data
from certkit.identification.five_steps import extract
from certkit.mechanics import simulate
from docs.make.markdown import signed, table

if TYPE_CHECKING:
    from collections.abc import Callable

    from certkit.documents.self_check import ChannelCheck

MOVED = (-0.005, 0.0, 0.005)
"""m: half an element of the finite-element run's fascia."""


def heights_table(front: str, tell: Callable[[str], None]) -> str:
    """Drive the leg by the run's contact forces where they act, lower and higher; return peaks and times."""
    tell("drive the leg by forces at other heights")
    case = shipped_root() / "examples" / "extract" / front / "case.yaml"
    document = load("case", case).document
    data = read_case_data(document.histories, case.parent)
    result = extract(document, case.parent, case_folder=case.parent, data=data)
    setup = prepare(PROCEDURE)
    flesh = setup.legform.flesh
    forces = recorded_forces(
        result, data.motion, face=float(flesh.face or 0.0), thickness=float(flesh.thickness)
    )
    run = CheckedRun(result, data, document.settings)
    columns = []
    for by in MOVED:
        moved = [replace(force, height=force.height + by) for force in forces]
        done = simulate(setup.procedure, setup.legform, driven=moved)
        begun = result.start + done.run.contact
        columns.append({c.name: c for c in channel_checks(data, done, start=begun, until=run.until)})
    rows = [
        (
            name,
            *(_said(column[name]) for column in columns),
        )
        for name in ("T1", "T2", "T3", "T4", "F1", "F3", "MCL")
    ]
    return table(("channel", "5 mm lower", "where they act", "5 mm higher"), rows)


def _said(channel: ChannelCheck) -> str:
    """Return a peak's error and by how much it comes later."""
    later = 1e3 * (channel.time - channel.run_time)
    return f"{signed(channel.error_percent)} %, {signed(later)} ms"
