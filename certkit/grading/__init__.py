"""From a recording to a verdict: criteria, corridors, decision rules, and the result document."""

from certkit.grading.decision import SIMPLE_ACCEPTANCE, DecisionRule
from certkit.grading.document import from_json, read_result, to_json, write_result
from certkit.grading.evaluate import criterion_values, evaluate, grade_criteria, overall
from certkit.grading.family import with_spread
from certkit.grading.quality import grade_quality
from certkit.grading.refinement import numerical_uncertainties, step_change_percent
from certkit.grading.verdicts import exit_code, worst

__all__ = [
    "SIMPLE_ACCEPTANCE",
    "DecisionRule",
    "criterion_values",
    "evaluate",
    "exit_code",
    "from_json",
    "grade_criteria",
    "grade_quality",
    "numerical_uncertainties",
    "overall",
    "read_result",
    "step_change_percent",
    "to_json",
    "with_spread",
    "worst",
    "write_result",
]
