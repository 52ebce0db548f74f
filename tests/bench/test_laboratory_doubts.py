"""A laboratory file that does not go with its test is remarked on: other items, gaps, misspelt words."""

from __future__ import annotations

from pathlib import Path

import pytest

import certkit
from certkit.bench.verify import verify

DATA = Path(__file__).parents[2] / "examples" / "measured"
LAB = (DATA / "lab.yaml").read_text("utf-8")


def _without(words: str) -> str:
    return "\n".join(line for line in LAB.splitlines() if words not in line) + "\n"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (LAB, None),
        (LAB.replace("legform: Flex-PLI GTR", "legform: FlexPLI type GTR, lower leg"), None),
        (
            LAB.replace("legform: Flex-PLI GTR", "legform: aPLI"),
            "calls the item `aPLI`; it was graded as a Flex-PLI",
        ),
        (_without("channel: "), None),
        (_without("channel: T4"), "Of T4 the laboratory's file tells no calibration"),
        (LAB.replace("channel: T2", "channel: T1"), "Of T2 the laboratory's file tells no calibration"),
        (LAB + "conditions: {legform mas: 15 kg}\n", "was `legform mass` meant"),
        (LAB + "conditions: {ram mass: 8.1 kg}\n", None),
    ],
    ids=[
        "as it is",
        "other words",
        "other item",
        "no sensors",
        "gap",
        "twice",
        "misspelt",
        "of another test",
    ],
)
def test_what_does_not_go_with_the_test_is_remarked_on(text: str, said: str | None, tmp_path: Path):
    text = text.replace("sensors:\ndecision", "decision").replace("sensors:\n#", "#")
    (tmp_path / "lab.yaml").write_text(text, "utf-8")
    result = certkit.grade("pendulum", DATA / "FLX-0007-pendulum.zip", laboratory=tmp_path / "lab.yaml")
    codes = {"item-of-other-kind", "calibration-not-told", "condition-misspelt"}
    found = [str(each) for each in result.coded_remarks if each.code in codes]
    assert len(found) == (said is not None)
    assert said is None or said in found[0]
    certkit.render(result, tmp_path / "run", "none")
    assert verify(tmp_path / "run").holds
