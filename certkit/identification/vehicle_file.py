"""The vehicle document that an extraction yields, as YAML text."""

from __future__ import annotations

import json
import re
from hashlib import sha256
from typing import TYPE_CHECKING

from certkit.definitions.loading.old_forms import spring_names
from certkit.errors import DataError
from certkit.identification.first_steps import CARRIES
from certkit.identification.grouping import GROUND

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from certkit.documents.extraction import ExtractionResult, GroupResult, LawResult, PathResult, SheetResult

_HASH_DIGITS = 12


def vehicle_text(result: ExtractionResult) -> str:
    """Write the vehicle document of an extraction.

    The impactor is left out, and so are `loose_groups`. A group that only a path without a law holds to the
    ground is taken for ground itself, because nothing is known of how it gives way.

    Raises
    ------
    DataError
        When no fascia or hood group has a face, so that nothing could be hit.
    """
    held = _held(result.paths)
    loose = loose_groups(result.groups, result.paths)
    groups = [g for g in result.groups if g.kind != "impactor" and g.name not in held | loose]
    if not any(g.position is not None for g in groups):
        if any(g.position is not None and g.name in loose for g in result.groups):
            raise DataError(
                "from no group with a face a path that carries a force leads to the ground: the leg would "
                "push the front away; add the paths to `ground`"
            )
        raise DataError(
            "no group has a face (low, high, position): the leg would hit nothing; add faces to the case"
        )
    inputs = sorted(result.inputs.items())
    together = sha256("".join(f"{name} {digest}\n" for name, digest in inputs).encode()).hexdigest()
    source = f"extracted from the case {result.case} (inputs, SHA-256 {together[:_HASH_DIGITS]})"
    files = [f"input {name}: SHA-256 {digest}" for name, digest in inputs]
    lines = [
        f"# Written by certkit extract from the case {result.case}; do not edit, extract again.",
        f"vehicle: {result.vehicle or result.case}",
        f"title: {_quoted(result.title)}",
        "origin:",
        f"  source: {_quoted(source)}",
        "  confidence: derived",
        "groups:",
    ]
    lines += [line for group in groups for line in _group(group)]
    lines.append("springs:")
    known = {g.name for g in groups} | {GROUND}
    springs: list[tuple[str, str, LawResult, float]] = []
    for path in result.paths:
        if path.law is None or path.source in held:
            continue
        target = GROUND if path.target in held else path.target
        if path.source in known and target in known:
            springs.append((path.source, target, path.law, max(path.shortening)))
    for name, (source, target, law, seen) in zip(
        spring_names([s[:2] for s in springs]), springs, strict=True
    ):
        lines += _spring(name, source, target, law)
        if seen > 0:
            lines.append(f"    seen: {_number(1e3 * seen)} mm")
    sheets = [
        (path.source, path.target, path.sheet)
        for path in result.paths
        if path.sheet is not None and path.source in known and path.target in known
    ]
    if sheets:
        lines.append("sheets:")
    for name, (source, target, sheet) in zip(spring_names([s[:2] for s in sheets]), sheets, strict=True):
        lines += _sheet(name, source, target, sheet)
    lines.append("notes:")
    lines += [f"  - {_quoted(note)}" for note in (*result.warnings, *result.notes, *files)] or ["  []"]
    return "\n".join(lines) + "\n"


def loose_groups(groups: Iterable[GroupResult], paths: Sequence[PathResult]) -> set[str]:
    """Return the groups that no law holds to the ground, in however many steps.

    The run does not tell how they give way: nothing touched them, or their paths were forgotten.
    """
    reached = {GROUND, *_held(paths)}
    links = [(p.source, p.target) for p in paths if p.law is not None or p.sheet is not None]
    before = 0
    while len(reached) > before:
        before = len(reached)
        reached |= {end for link in links if reached & set(link) for end in link}
    return {g.name for g in groups if g.kind != "impactor"} - reached


def _held(paths: Sequence[PathResult]) -> set[str]:
    """Return the groups that only paths without a law hold to the ground, though they carry something."""
    carries = CARRIES * max(max(map(abs, p.impulse)) for p in paths)
    grounded = [p for p in paths if p.target == GROUND and max(map(abs, p.impulse)) >= carries]
    return {p.source for p in grounded if p.law is None} - {p.source for p in grounded if p.law is not None}


def _group(group: GroupResult) -> list[str]:
    lines = [f"  {group.name}:", f"    kind: {group.kind}", f"    mass: {_number(group.mass)} kg"]
    if group.position is not None and group.low is not None and group.high is not None:
        lines += [
            f"    position: {_number(1e3 * group.position)} mm",
            f"    low: {_number(1e3 * group.low)} mm",
            f"    high: {_number(1e3 * group.high)} mm",
            f"    slope: {_number((group.slope or 0.0) + 0.0)}",
        ]
        for title, key, unit, scale, outlines in (
            ("outlines", "at", " mm", 1e3, group.outlines),
            ("springing back", "share", "", 1.0, group.springing_back),
        ):
            if outlines:
                lines.append(f"    {title}:")
            lines += [
                f"      - {{{key}: {_number(scale * line.at)}{unit}, points: [{_points(line.points)}]}}"
                for line in outlines
            ]
    return lines


def _points(points: tuple[tuple[float, float], ...]) -> str:
    return ", ".join(f"[{_number(1e3 * x)} mm, {_number(1e3 * z)} mm]" for x, z in points)


def _spring(name: str, source: str, target: str, law: LawResult) -> list[str]:
    lines = [f"  {_key(name)}:", f"    between: [{source}, {target}]", "    loading:"]
    lines += [
        f"      - [{_number(1e3 * x)} mm, {_number(f)} N]"
        for x, f in zip(law.shortening, law.force, strict=True)
    ]
    lines.append(f"    unloading: {_number(1e-3 * law.unloading)} N/mm")
    if law.residual > 0:
        lines.append(f"    residual: {_number(law.residual)}")
        lines.append(f"    permanent set: {_number(law.permanent_set)}")
    if law.damping > 0:
        lines.append(f"    damping: {_number(law.damping)} N·s/m")
    if law.tension:
        lines.append("    tension: true")
    return lines


def _sheet(name: str, source: str, target: str, sheet: SheetResult) -> list[str]:
    lines = [f"  {_key(name)}:", f"    between: [{source}, {target}]", "    path:"]
    lines += [
        f"      - [{_number(1e3 * at)} mm, {_number(1e3 * x)} mm, {_number(f)} N]"
        for at, x, f in zip(sheet.progress, sheet.shortening, sheet.force, strict=True)
    ]
    lines.append("    springing back:")
    lines += [
        f"      - [{_number(at)}, {_number(1e3 * x)} mm, {_number(f)} N]"
        for at, x, f in zip(sheet.shares, sheet.back_shortening, sheet.back_force, strict=True)
    ]
    lines.append(f"    stiffness: {_number(1e-3 * sheet.stiffness)} N/mm")
    lines.append(f"    damping: {_number(sheet.damping)} N·s/m")
    if not sheet.tension:
        lines.append("    tension: false")
    return lines


def _key(name: str) -> str:
    return name if re.fullmatch(r"[\w ]+", name) else _quoted(name)


def _number(value: float) -> str:
    text = f"{value:.5g}"
    return text if "e" not in text else f"{value:.9f}".rstrip("0").rstrip(".") or "0"


def _quoted(text: str) -> str:
    """Quote as JSON, which is YAML too."""
    return json.dumps(text, ensure_ascii=False)
