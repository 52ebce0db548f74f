"""A run of a front whose laws are known: a lumped front hit by a leg, told as finite elements tell a run.

The files are those of examples/extract/front1: momenta, contact and ground forces, the leg's channels, the
motion of nodes on the faces and on the leg's axis. What an extraction of them misses is its own error.
"""

from __future__ import annotations

import csv
import math
from typing import TYPE_CHECKING

import numpy as np

from certkit.bench.setup import prepare
from certkit.mechanics import simulate
from certkit.mechanics.rig.front_faces import face_strips
from tests.support.changed_fronts import FRONT

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from certkit.definitions.vehicle import Group, Vehicle
    from certkit.mechanics import Simulation

    Values = NDArray[np.float64]

FREE, LASTS = 1.0, 58.0
"""ms of free flight, and from first contact on."""
EVERY = 0.08
"""ms between two rows, as in front1."""
CHANNELS = ("F1", "F2", "F3", "T1", "T2", "T3", "T4", "MCL", "ACL", "PCL")
MASS = 13.314
"""kg of `fe-leg`."""
NODES = 0.02
"""m between two nodes of a face."""


def made_up_run(
    folder: Path, vehicle: str, *, speed: float, end: float, changes: Mapping[str, str] | None = None
) -> Path:
    """Let `fe-leg` hit a front; write the run into a folder and return its case.

    Parameters
    ----------
    folder : Path
    vehicle : str
        Of the library.
    speed, end : float
        Of the flight: m/s, and the leg's lower end above the ground, m.
    changes : mapping of str to str, optional
        Values of the vehicle, by their paths.
    """
    own = {f"vehicle.{path}": value for path, value in (changes or {}).items()}
    own |= {"vehicle": vehicle, "vehicle.friction": "0", "run.until": f"{LASTS + 2} ms"}
    own |= {"rig.free flight.speed": f"{speed} m/s", "rig.free flight.end above ground": f"{end} m"}
    setup = prepare("vehicle-fe-front", overrides=own)
    front = setup.vehicle
    assert front is not None
    done = simulate(setup.procedure, setup.legform, vehicle=front)
    told = _Told(done, front, speed)
    told.write(folder)
    (folder / "case.yaml").write_text(told.case())
    return folder / "case.yaml"


class _Told:
    """A simulation on the rows of a finite-element run."""

    def __init__(self, done: Simulation, front: Vehicle, speed: float) -> None:
        self.done, self.front, self.speed = done, front, speed
        self.own = 1e3 * (done.run.time - done.run.contact)
        self.time = np.arange(0.0, FREE + LASTS, EVERY)
        names = done.rig.front.groups if done.rig.front else {}
        first = done.run.tracks.shape[1] - len(names)
        tracks = done.run.tracks[:, first:, 0]
        self.moved = {name: tracks[:, k] - tracks[0, k] for k, name in enumerate(names)}
        self.faces = {n: g for n, g in front.groups.items() if g.position is not None}
        self.pressed = {name: np.zeros_like(self.own) for name in self.faces}
        for k, strip in enumerate(done.rig.front.strips if done.rig.front else ()):
            force = done.readings[f"strip {k} force"]
            self.pressed[strip.lower] = self.pressed[strip.lower] + (1 - strip.share) * force
            self.pressed[strip.upper] = self.pressed[strip.upper] + strip.share * force

    def rows(self, values: Values) -> Values:
        """Return a history on the run's rows; before contact it is what it was at first."""
        return np.interp(self.time - FREE, self.own, values)

    def impulse(self, force: Values) -> Values:
        """Return ∫F dt, N·s."""
        steps = 0.5 * (force[1:] + force[:-1]) * 1e-3 * np.diff(self.own)
        return np.concatenate([[0.0], np.cumsum(steps)])

    def write(self, folder: Path) -> None:
        """Write all tables."""
        parts: dict[str, Values] = {}
        for name, x in self.moved.items():
            momentum = float(self.front.groups[name].mass) * np.gradient(x, 1e-3 * self.own)
            parts |= {
                f"{name}_x__px_Ns": momentum,
                f"{name}_x__cgx_mm": 1e3 * x,
                f"{name}_x__frontx_mm": 1e3 * x,
            }
        contacts = {f"leg_{n}_x": f for n, f in self.pressed.items()}
        grounds: dict[str, Values] = {}
        for name, spring in self.front.springs.items():
            source, target = spring.between
            force = self.done.readings[f"spring {name} force"]
            if target == "ground":
                grounds[f"gx_{source}_x__F_N"] = force
            elif not spring.tension:
                contacts[f"{target}_{source}_x"] = force
        forces = {f"{n}__Jx_Ns": self.impulse(f) for n, f in contacts.items()}
        recording = self.done.recording
        pressed = sum(self.pressed.values(), np.zeros_like(self.own))
        leg = {"leg_px_Ns": self.rows(MASS * self.speed - self.impulse(pressed))}
        for channel in CHANNELS:
            scale, unit = (1e3, "elong_mm") if channel.endswith("CL") else (1.0, "Nm")
            values = np.interp(self.time - FREE, 1e3 * recording.time, recording[channel].values)
            leg[f"{channel}_{unit}"] = scale * values
        for file, columns in (
            ("vehicle_groups", parts),
            ("contact_forces", forces),
            ("ground_forces", grounds),
        ):
            _write(folder / f"{file}.csv", self.time, {n: self.rows(v) for n, v in columns.items()})
        _write(folder / "leg_channels.csv", self.time, leg)
        with (folder / "animation_1ms.csv").open("w", newline="") as stream:
            out = csv.writer(stream)
            out.writerow(("time_ms", "node", "line", "x_mm", "z_mm"))
            out.writerows(self.nodes())
        with (folder / "groups_table.csv").open("w", newline="") as stream:
            out = csv.writer(stream)
            out.writerow(("group", "mass_kg", "z_low_mm", "z_high_mm", "x_front_min_mm", "x_front_max_mm"))
            for name, group in self.front.groups.items():
                low, high, x = (1e3 * float(v or 0.0) for v in (group.low, group.high, group.position))
                out.writerow(
                    (f"{name}_x", float(group.mass), *((low, high, x, x) if name in self.faces else [""] * 4))
                )

    def nodes(self) -> list[tuple[object, ...]]:
        """Return time, node, line, x, z of the faces and of the leg's axis, mm."""
        frames = np.arange(0.0, FREE + LASTS, 1.0)
        rows: list[tuple[object, ...]] = []
        for name, group in self.faces.items():
            for k, (x, z) in enumerate(_line(group, self.faces.values())):
                moved = np.interp(frames - FREE, self.own, self.moved_at(group.kind, z))
                line = f"{name}_x"
                rows += [
                    (t, f"{name}{k:02d}", line, 1e3 * (x + u), 1e3 * z)
                    for t, u in zip(frames, moved, strict=True)
                ]
        motion = self.done.motion
        bones = [k for k, shape in enumerate(motion.shapes) if shape.kind in {"bone", "knee"}]
        ground = max(z for shape in motion.scene if shape.kind == "ground" for _, z in shape.outline)
        poses, own = np.array(motion.poses), 1e3 * np.array(motion.times)
        for k in bones:
            zs = [z for _, z in motion.shapes[k].outline]
            for end in (min(zs), max(zs)):
                x = poses[:, k, 0] - end * np.sin(poses[:, k, 2])
                z = poses[:, k, 1] + end * np.cos(poses[:, k, 2])
                along = np.interp(frames - FREE, own, x - self.shift())
                along += 1e-3 * self.speed * np.minimum(frames - FREE, 0.0)
                up = np.interp(frames - FREE, own, z - ground)
                node = f"axis {k} {end:.4f}"
                rows += [
                    (t, node, "leg_axis", 1e3 * x, 1e3 * z) for t, x, z in zip(frames, along, up, strict=True)
                ]
        return rows

    def moved_at(self, kind: str, z: float) -> Values:
        """Return how far a flat face has moved at a height: a strip moves with the groups beside it, m."""
        strips = [s for s in face_strips(self.front, 0.0) if self.front.groups[s.lower].kind == kind]
        strips.sort(key=lambda s: s.z)
        moved = [(1 - s.share) * self.moved[s.lower] + s.share * self.moved[s.upper] for s in strips]
        place = float(np.interp(z, [s.z for s in strips], np.arange(len(strips))))
        low = min(int(place), len(strips) - 2)
        return (1 - place + low) * moved[low] + (place - low) * moved[low + 1]

    def shift(self) -> float:
        """Return how much further along x the front stands on the rig than in its document, m."""
        motion = self.done.motion
        k, shape = next((k, s) for k, s in enumerate(motion.shapes) if s.name in self.faces)
        return motion.poses[0][k][0] + shape.outline[0][0] - _line(self.faces[shape.name])[0][0]

    def case(self) -> str:
        """Return the case: springs that only push are contacts, those that pull, too, were not recorded."""
        head = (FRONT / "case.yaml").read_text().partition("groups:")[0]
        lines = [
            head.replace("  outlines: params.json\n", "").replace(
                '"gx_*__F_N", shortening: "gx_*__disp_mm"', '"gx_*__F_N"'
            )
        ]
        lines += ["groups:", "  leg: {kind: impactor, parts: [leg]}"]
        for name, group in self.front.groups.items():
            rule = ", moves with: front" if group.kind == "hood" else ""
            lines.append(f'  {name}: {{kind: {group.kind}, parts: ["{name}_*"]{rule}}}')
        lines.append("paths:")
        lines += [f'  - {{between: [leg, {n}], contact: "leg_{n}_*", law: false}}' for n in self.faces]
        for spring in self.front.springs.values():
            source, target = spring.between
            known = f', spring: "{source}_*"' if target == "ground" else ""
            known = known if spring.tension or known else f', contact: "{target}_{source}_*"'
            tension = ", tension: true" if spring.tension else ""
            lines.append(f"  - {{between: [{source}, {target}]{known}{tension}}}")
        return "\n".join(lines) + "\n"


def _line(group: Group, faces: Iterable[Group] = ()) -> list[tuple[float, float]]:
    """Return the nodes of a flat face from below, without the first of one of its kind that goes on above."""
    low, high, middle = (float(v or 0.0) for v in (group.low, group.high, group.position))
    goes_on = any(f.kind == group.kind and abs(float(f.low or 0.0) - high) < NODES for f in faces)
    count = max(3, math.ceil((high - low) / NODES))
    heights = [low + (high - low) * k / count for k in range(count + (not goes_on))]
    return [(middle + float(group.slope or 0.0) * (z - 0.5 * (low + high)), z) for z in heights]


def _write(path: Path, time: Values, columns: dict[str, Values]) -> None:
    table = np.column_stack([time, *columns.values()])
    np.savetxt(path, table, "%.8g", ",", header=",".join(["time_ms", *columns]), comments="")
