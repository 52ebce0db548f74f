"""certkit: a regulatory certification bench for the Flex-PLI legform.

The names that a script or a notebook needs; each is imported when first used, so that `import certkit` costs
nothing. Every path may be a string.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from certkit._version import __version__

if TYPE_CHECKING:
    from certkit.bench.assess_campaign import campaign
    from certkit.bench.certify import certify
    from certkit.bench.compare import compare
    from certkit.bench.export import export
    from certkit.bench.extract_vehicle import extract
    from certkit.bench.grade_measurement import grade
    from certkit.bench.legform_logbook import logbook
    from certkit.bench.load_by_kind import load
    from certkit.bench.render_documents import render
    from certkit.bench.round_robin import round_robin
    from certkit.bench.run_simulation import run
    from certkit.bench.verify import verify
    from certkit.studies.calibration.calibrate_legform import calibrate
    from certkit.studies.carry_out_study import study
    from certkit.studies.leg_twin import twin
    from certkit.studies.propagate_uncertainty import uncertainty

_FILES = {
    "calibrate": "certkit.studies.calibration.calibrate_legform",
    "campaign": "certkit.bench.assess_campaign",
    "certify": "certkit.bench.certify",
    "compare": "certkit.bench.compare",
    "export": "certkit.bench.export",
    "extract": "certkit.bench.extract_vehicle",
    "grade": "certkit.bench.grade_measurement",
    "load": "certkit.bench.load_by_kind",
    "logbook": "certkit.bench.legform_logbook",
    "render": "certkit.bench.render_documents",
    "round_robin": "certkit.bench.round_robin",
    "run": "certkit.bench.run_simulation",
    "study": "certkit.studies.carry_out_study",
    "twin": "certkit.studies.leg_twin",
    "uncertainty": "certkit.studies.propagate_uncertainty",
    "verify": "certkit.bench.verify",
}

__all__ = [
    "__version__",
    "calibrate",
    "campaign",
    "certify",
    "compare",
    "export",
    "extract",
    "grade",
    "load",
    "logbook",
    "render",
    "round_robin",
    "run",
    "study",
    "twin",
    "uncertainty",
    "verify",
]


def __getattr__(name: str) -> Any:  # noqa: ANN401  # a module's attributes are of any type
    """Import a name from the file it lives in."""
    if name not in _FILES:
        raise AttributeError(f"module `certkit` has no `{name}`; it hands on {', '.join(sorted(_FILES))}")
    return getattr(import_module(_FILES[name]), name)


def __dir__() -> list[str]:
    """List what the module hands on."""
    return sorted(__all__)
