"""The certificate of one legform (schema `certkit-certificate/1`): the verdict over its certification tests.

It holds the results of the tests whole, and the overview of the legform's logbook, so that everything in it
can be graded again from the document alone.
"""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from certkit.documents.logbook_overview import LegOverview
from certkit.documents.output_document import OutputDocument, Part
from certkit.documents.result import Result, Verdict
from certkit.reasons import Reason

LOGBOOK = "logbook.html"
"""What the logbook is attached to its PDF as."""


class CertifiedTest(Part):
    """One test that the certificate rests on, or that is missing for it."""

    procedure: str
    title: str = ""
    verdict: Verdict
    id: Annotated[str, Field(description="Of the test's result; empty where the test is missing.")] = ""
    day: Annotated[str | None, Field(description="When it was tested.")] = None
    number: Annotated[str, Field(description="Of the test's report.")] = ""
    revision: int = 0
    replaces: Annotated[str, Field(description="Id of the report that this one replaced.")] = ""
    laboratory: str = ""
    reasons: list[str] = []
    coded_reasons: Annotated[list[Reason], Field(description="Why it has not passed.")] = []


class LegformCertificate(OutputDocument):
    """Verdict over all certification tests of one legform, with the tests, their validity and their data."""

    noun: ClassVar = "legform certificate"
    file_name: ClassVar = "certificate.json"
    made_by: ClassVar = "certkit certify"

    schema_: Annotated[Literal["certkit-certificate/1"], Field(alias="schema")] = "certkit-certificate/1"
    serial: str
    legform: Annotated[str, Field(description="What it is.")] = ""
    number: Annotated[str, Field(description="Of the certificate.")] = ""
    day: Annotated[str, Field(description="Day of issue.")]
    verdict: Annotated[Verdict, Field(description="The worst of the tests; a missing one is not evaluated.")]
    remarks: list[str] = []
    coded_remarks: Annotated[list[Reason], Field(description="What stands against it, or limits it.")] = []
    rules: Annotated[str, Field(description="Rules of validity.")]
    next_due: Annotated[str | None, Field(description="Day from which on a certification is due.")] = None
    laboratory: Annotated[dict[str, Any] | None, Field(description="Who issues it.")] = None
    tests: list[CertifiedTest]
    logbook: Annotated[LegOverview, Field(description="The legform's logbook on the day of issue.")]
    results: Annotated[list[Result], Field(description="The tests, whole.")]
    certkit: str
