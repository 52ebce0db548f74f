"""From a recording to a verdict: criteria, corridors, decision rules, and the result document."""

from certkit.documents.verdicts import exit_code, worst
from certkit.grading.decision import SIMPLE_ACCEPTANCE, DecisionRule
from certkit.grading.evaluate import criterion_values, evaluate, grade_criteria
from certkit.grading.family_spread import with_spread
from certkit.grading.grading_terms import NO_LABORATORY, GradingTerms, LaboratoryTerms, SimulatedTerms
from certkit.grading.measure_all import Measurements, measure_all
from certkit.grading.overall_verdict import overall
from certkit.grading.quality_gate import grade_quality
from certkit.grading.refinement import StepChange, largest_step_change, numerical_uncertainties

__all__ = [
    "NO_LABORATORY",
    "SIMPLE_ACCEPTANCE",
    "DecisionRule",
    "GradingTerms",
    "LaboratoryTerms",
    "Measurements",
    "SimulatedTerms",
    "StepChange",
    "criterion_values",
    "evaluate",
    "exit_code",
    "grade_criteria",
    "grade_quality",
    "largest_step_change",
    "measure_all",
    "numerical_uncertainties",
    "overall",
    "with_spread",
    "worst",
]
