# ruff: noqa: INP001  # a script beside its data
"""Write one finite-element run of a leg, `table/leg.csv`, as the solvers' own files: binout and T01.

The table holds 32-bit numbers of an OpenRadioss run (a leg against a made-up car front). The binout is not
written by LS-DYNA, nor the T01 by OpenRadioss: they are for trying the readers. From the top of a checkout,
with lasso-python installed: `python examples/finite-elements/make.py`.
"""

from __future__ import annotations

import gzip
import struct
import tempfile
from pathlib import Path

import numpy as np
from lasso.dyna.lsda_py3 import Lsda

from certkit.exchange.fe.numeric_table import read_table

HERE = Path(__file__).parent
GAUGES = ("F1", "F2", "F3", "T1", "T2", "T3", "T4")
LIGAMENTS = ("MCL", "LCL", "ACL", "PCL")
KILO, MILLI = 1e3, 1e-3


def read() -> dict[str, np.ndarray]:
    """Return the table in kg, mm, ms: moments in kN·mm (= N·m), forces in kN, energies in J, masses in kg."""
    return dict(read_table(HERE / "table" / "leg.csv").columns)


def force_of(impulse: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Return the central difference of an impulse, as OpenRadioss' converter takes it."""
    inner = (impulse[2:] - impulse[:-2]) / (time[2:] - time[:-2])
    first = (impulse[1] - impulse[0]) / (time[1] - time[0])
    last = (impulse[-1] - impulse[-2]) / (time[-1] - time[-2])
    return np.array([first, *inner, last])


def write_binout(run: dict[str, np.ndarray], path: Path) -> None:
    """Write secforc, deforc, rcforc, nodout and glstat."""
    tables = {
        "secforc": ([f"gauge {g}" for g in GAUGES], {"y_moment": [run[f"{g}_Nm"] for g in GAUGES]}),
        "deforc": ([], {"displacement": [run[f"{name}_elong_mm"] for name in LIGAMENTS]}),
        "rcforc": (["leg to front"], {"x_force": [run["contact_N"] / KILO]}),
        "nodout": (["knee"], {"x_velocity": [run["knee_vx_mps"]]}),
        "glstat": (
            None,
            {
                "kinetic_energy": run["kinetic_J"] + run["rotation_J"],
                "internal_energy": run["internal_J"],
                "hourglass_energy": run["hourglass_J"],
                "sliding_interface_energy": run["contact_J"],
                "external_work": run["external_work_J"],
                "total_energy": run["kinetic_J"] + run["rotation_J"] + run["internal_J"],
                "mass": run["mass_kg"],
            },
        ),
    }
    with tempfile.TemporaryDirectory() as folder:
        plain = Path(folder) / "binout0000"
        file = Lsda(str(plain), "w")
        for table, (titles, variables) in tables.items():
            file.cd(f"/{table}/metadata")
            file.write("title", Lsda.I1, f"{'made-up front, not written by LS-DYNA':80}".encode())
            if titles is not None:
                count = len(next(iter(variables.values())))
                file.write("ids", Lsda.I4, range(1, count + 1))
                if titles:
                    file.write("legend_ids", Lsda.I4, range(1, count + 1))
                    file.write("legend", Lsda.I1, "".join(f"{title:80}" for title in titles).encode())
            for row, time in enumerate(run["time_ms"]):
                file.cd(f"/{table}/d{row + 1:06d}")
                file.write("time", Lsda.R8, [time])
                for name, values in variables.items():
                    at = [values[row]] if titles is None else [each[row] for each in values]
                    file.write(name, Lsda.R8, at)
        file.close()
        path.write_bytes(gzip.compress(plain.read_bytes(), mtime=0))


def write_radioss(run: dict[str, np.ndarray], path: Path) -> None:
    """Write globals and groups of beams, springs, a contact (as impulse) and a node, with their titles."""
    energies = ("internal", "kinetic", None, None, None, "mass", None, "rotation", "external_work", None)
    energies += ("contact", "hourglass")
    nothing = np.zeros_like(run["time_ms"])
    globals_ = [
        nothing if name is None else run["mass_kg" if name == "mass" else f"{name}_J"] for name in energies
    ]
    groups = [
        (5, [f"gauge {g}" for g in GAUGES], ["M2"], [run[f"{g}_Nm"] for g in GAUGES]),
        (6, list(LIGAMENTS), ["LX"], [run[f"{name}_elong_mm"] for name in LIGAMENTS]),
        (101, ["leg to front"], ["FNX"], [run["contact_Ns"]]),
        (0, ["knee"], ["VX"], [run["knee_vx_mps"]]),
    ]
    title = "leg against a made-up front, not written by OpenRadioss"
    words = [_record(struct.pack(">i", 3040) + f"{title:80}".encode()), _record(f"{'':80}".encode())]
    words += [_integers(1, 0, 0, 0, len(groups), len(globals_)), _integers(*range(1, len(globals_) + 1))]
    words += [_record(struct.pack(">i", 1) + f"{'leg':40}".encode() + struct.pack(">4i", 0, 0, 0, 0))]
    names = []
    for number, (kind, titles, variables, _) in enumerate(groups, 1):
        head = struct.pack(">5i", number, kind, 0, len(titles), len(variables))
        words.append(_record(head + f"{'':40}".encode()))
        words += [_record(struct.pack(">i", k) + f"{t:40}".encode()) for k, t in enumerate(titles, 1)]
        words.append(_integers(*([4] if kind == 0 else [1] if kind == 101 else [5])))
        names += [f"{kind:10d}\n{variable:10}\n" for _ in titles for variable in variables]
    for row, time in enumerate(run["time_ms"]):
        words += [_reals(time), _reals(*(values[row] for values in globals_))]
        words += [_reals(*(values[row] for values in columns)) for _, _, _, columns in groups]
    path.write_bytes(gzip.compress(b"".join(words), mtime=0))
    path.with_name(path.name.removesuffix(".gz") + "_TITLES").write_text("".join(names), encoding="ascii")


def _record(content: bytes) -> bytes:
    length = struct.pack(">i", len(content))
    return length + content + length


def _integers(*values: int) -> bytes:
    return _record(struct.pack(f">{len(values)}i", *values))


def _reals(*values: float) -> bytes:
    return _record(struct.pack(f">{len(values)}f", *values))


if __name__ == "__main__":
    leg = read()
    for name in ("binout", "openradioss"):
        (HERE / name).mkdir(exist_ok=True)
    write_binout(leg, HERE / "binout" / "binout0000.gz")
    write_radioss(leg, HERE / "openradioss" / "legT01.gz")
