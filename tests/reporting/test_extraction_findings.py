"""What an extraction says of its self-checks: prediction or compensation, and whose error it is."""

from __future__ import annotations

import pytest

from certkit.reporting.extraction_findings import findings
from certkit.reporting.language import language
from tests.support.synthetic_extraction import channel_check, extraction


def said(leg: float, both: float, tongue: str = "en") -> list[str]:
    """Return what is said where T1 errs so in the leg alone, and in leg and front together."""
    result = extraction()
    errors = {"leg alone": leg, "coupled": both}
    checks = [
        check.model_copy(update={"channels": (channel_check("T1", 300.0, errors[check.id]),)})
        if check.id in errors
        else check
        for check in result.checks
    ]
    changed = result.model_copy(update={"checks": tuple(checks)})
    return findings(changed, language(tongue).word)


@pytest.mark.parametrize(
    ("leg", "both", "told"),
    [
        (0.02, -0.03, "A prediction within 10 %, by the leg, the front and both: tibia moment 1."),
        (-0.12, 0.01, "tibia moment 1 agrees by compensation (+1 %): the leg alone is −12 % off"),
        (-0.2, -0.18, "tibia moment 1 is −18 % off by the leg"),
        (0.02, 0.2, "tibia moment 1 is +20 % off by the front, which adds +18 %"),
    ],
)
def test_agreement_is_called_prediction_only_where_leg_and_front_agree_each(
    leg: float, both: float, told: str
) -> None:
    assert any(sentence.startswith(told) for sentence in said(leg, both))


def test_the_face_that_moves_worst_is_named_with_its_worst_law() -> None:
    worst = said(0.0, 0.0)[-1]
    assert worst == "Under the run's own forces F2 moves 12 % off; of its laws F1 – F2 fits worst (5 %)."


@pytest.mark.parametrize("tongue", ["de", "ja"])
def test_findings_are_told_in_every_language(tongue: str) -> None:
    for errors in ((0.0, 0.0), (-0.12, 0.01), (-0.2, -0.18), (0.02, 0.2)):
        assert not set(said(*errors, tongue)) & set(said(*errors))
