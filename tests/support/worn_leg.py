"""A legform's pendulum tests over two years whose tibia moments creep up: made from one graded test."""

from __future__ import annotations

from datetime import date, timedelta

from certkit.documents.result import Result

BEGIN = date(2024, 3, 4)


def worn(result: Result, tests: int = 12, creep: float = 0.004) -> list[Result]:
    """Return that many tests, eight weeks apart, each with curves and values larger by `creep`."""
    found = []
    for number in range(tests):
        factor = 1.0 + creep * (number - tests // 2) + (0.001 if number % 2 else -0.001)
        criteria = [
            c if c.value is None else c.model_copy(update={"value": c.value * factor, "margin": None})
            for c in result.criteria
        ]
        curves = result.curves
        if curves is not None:
            series = {
                name: each.model_copy(update={"values": [v * factor for v in each.values]})
                for name, each in curves.series.items()
            }
            curves = curves.model_copy(update={"series": series})
        header = result.laboratory or {}
        day = BEGIN + timedelta(weeks=8 * number)
        test = {"performed": day.isoformat(), "number": f"{day.year}-{number + 1:03}"}
        provenance = result.provenance.model_copy(update={"inputs": []})
        changes = {
            "criteria": type(result.criteria)(criteria),
            "curves": curves,
            "channels": None,
            "laboratory": {**header, "test": test},
            "provenance": provenance,
            "id": "",
        }
        found.append(result.model_copy(update=changes).with_id())
    return found
