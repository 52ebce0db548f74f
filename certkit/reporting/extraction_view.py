"""What an extraction's page shows: the figures of its self-checks and of its load paths, in their order."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.reporting.channel_names import channel_scale, channel_words
from certkit.reporting.charts.extraction_charts import material_chart, momentum_chart, path_charts
from certkit.reporting.charts.face_profiles import face_profiles
from certkit.reporting.charts.group_response import contact, movement
from certkit.reporting.charts.leg_channels import channel_chart
from certkit.reporting.charts.load_paths import sketches
from certkit.reporting.charts.paired_bars import bars_of
from certkit.reporting.charts.run_and_model import leg_colours, run_and_model
from certkit.reporting.charts.spring_curves import farther, path_check, reach, spring_chart
from certkit.reporting.coupled_check import check_of, group_of, worst_group
from certkit.reporting.extraction_findings import findings
from certkit.reporting.extraction_text import left_out
from certkit.reporting.language import language

if TYPE_CHECKING:
    from certkit.documents.extraction import ExtractionResult, PathResult
    from certkit.documents.self_check import ChannelCheck, GroupCheck, PathCheck, SelfCheck
    from certkit.reporting.language import Translate
    from certkit.reporting.svg import Drawing


class ChannelView(Struct, frozen=True):
    """A channel of the leg with its figure; values in the unit that is shown."""

    check: ChannelCheck
    words: str
    scale: float
    unit: str
    drawing: Drawing | None


class GroupView(Struct, frozen=True):
    """A group with its figures: how it moves, and how the leg presses on it."""

    name: str
    kind: str
    coupled: GroupCheck | None
    alone: GroupCheck | None
    drawings: list[Drawing]


class SpringView(Struct, frozen=True):
    """A spring or sheet with its force over shortening, and what it did in the coupled run.

    `beyond` is how far model and run went, m, where the model went farther.
    """

    path: PathResult
    check: PathCheck | None
    beyond: tuple[float, float] | None
    drawing: Drawing | None


class PathView(Struct, frozen=True):
    """A load path with its histories."""

    path: PathResult
    drawings: list[Drawing]


class ExtractionView(Struct, frozen=True):
    """All that the page and the PDF of an extraction show, with its figures drawn."""

    stills: Drawing | None
    colours: Drawing | None
    leg_seen: bool
    worst: GroupView | None
    groups: list[GroupView]
    channels: list[ChannelView]
    checks: list[tuple[SelfCheck, list[ChannelView]]]
    contact_left_out: str | None
    findings: list[str]
    profile: Drawing | None
    sketches: list[Drawing]
    bars: list[Drawing]
    springs: list[SpringView]
    paths: list[PathView]
    momentum: Drawing | None
    material: Drawing | None


def extraction_view(result: ExtractionResult, spoken: str) -> ExtractionView:
    """Draw everything of an extraction, in a language."""
    t = language(spoken).word
    coupled, alone = check_of(result, "coupled"), check_of(result, "front alone")
    leg = check_of(result, "leg alone")
    told = coupled or leg
    fronts = coupled or alone
    groups = [_group(result, group.name, t) for group in fronts.groups] if fronts else []
    worst = worst_group(result)
    springs = [
        SpringView(
            path,
            path_check(result, path.name),
            reach(result, path) if farther(result, path) else None,
            spring_chart(result, path, t),
        )
        for path in result.paths
        if path.law or path.sheet
    ]
    return ExtractionView(
        stills=run_and_model(result.motion, t) if result.motion else None,
        colours=leg_colours(result.motion, t) if result.motion else None,
        leg_seen=bool(result.motion and any(line.kind == "leg" and line.run for line in result.motion.lines)),
        worst=next((group for group in groups if group.name == worst), None),
        groups=[group for group in groups if group.name != worst],
        channels=[_channel(c, channel_chart(told, c, leg if coupled else None, t), t) for c in told.channels]
        if told
        else [],
        checks=[(check, [_channel(c, None, t) for c in check.channels]) for check in result.checks],
        contact_left_out=left_out(result),
        findings=findings(result, t),
        profile=face_profiles(result, fronts, t) if fronts and fronts.groups else None,
        sketches=sketches(result, t),
        bars=bars_of(result, t),
        springs=[spring for spring in springs if spring.drawing],
        paths=[
            PathView(path, path_charts(result, path, t)[:2] if any(path.force) else [])
            for path in result.paths
        ],
        momentum=momentum_chart(result, t),
        material=material_chart(result.material, t) if result.material else None,
    )


def _group(result: ExtractionResult, name: str, t: Translate) -> GroupView:
    kind = next((group.kind for group in result.groups if group.name == name), "")
    return GroupView(
        name=name,
        kind=kind,
        coupled=group_of(check_of(result, "coupled"), name),
        alone=group_of(check_of(result, "front alone"), name),
        drawings=[drawn for drawn in (movement(result, name, t), contact(result, name, t)) if drawn],
    )


def _channel(check: ChannelCheck, drawing: Drawing | None, t: Translate) -> ChannelView:
    return ChannelView(check, channel_words(check.name, t), *channel_scale(check.name), drawing)
