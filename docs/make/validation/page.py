"""The page itself: the words of `page.template.md` with the numbers of fresh runs."""

from __future__ import annotations

from pathlib import Path
from string import Template
from typing import TYPE_CHECKING

from docs.make.validation import bench, contact_heights, extraction, leg, recorded_leg, tests

if TYPE_CHECKING:
    from collections.abc import Callable

TEMPLATE = Path(__file__).with_name("page.template.md")


def validation(tell: Callable[[str], None]) -> str:
    """Run everything the page rests on, and return it; takes some minutes."""
    results = bench.all_procedures(tell)
    changed = leg.variants(tell)
    kin = leg.family_results(tell, ("pendulum", "inverse", "inverse-seed"))
    front = extraction.front_checks(tell)
    steps = bench.steps_table("inverse", tell)
    bumpers = extraction.bumpers_table(tell)
    tell("run the physics tests")
    return Template(TEMPLATE.read_text()).substitute(
        procedures=bench.procedures_table(results),
        farthest=f"{100 * bench.farthest(results):.0f} %",
        middles=bench.middles_table(results),
        steps=steps,
        physics=tests.physics_table(),
        variants=leg.variants_table(changed),
        tension=leg.tension_sentences(changed),
        members=leg.family_size(),
        family=leg.family_table(kin),
        followed=recorded_leg.followed_table(tell),
        bumpers=bumpers,
        front=extraction.front_words(front),
        channels=extraction.channels_table(front),
        heights=contact_heights.heights_table(extraction.FRONT, tell),
        groups=extraction.groups_table(front),
        predicted=leg.prediction_table(tell),
    )
