"""Campaigns without files: points and their named values, judged by the shipped schemes."""

from __future__ import annotations

from hashlib import sha256

from certkit.definitions.loading.library import load
from certkit.documents.campaign_report import CampaignReport, CarFront, PointReport, PointValue, SourceReport
from certkit.documents.result import InputFile, Provenance
from certkit.grading.judge_car import judge_car
from certkit.grading.prediction_agreement import agreement
from certkit.grading.scheme_terms import SchemeTerms
from certkit.reporting.language import worded

SHEET = """\
campaign: made-up
title: A <made-up> car
car: {name: Car, symmetric: true}
schemes: [r127, euro-ncap-flex-pli]
targets: {of: r127, share: 80 %}
at least: {euro-ncap-flex-pli: 5}
points: [{point: L0, across: 0 mm}]
"""
UNITS = {"MCL": "mm", "ACL": "mm", "PCL": "mm"}
GOOD = {"T1": 200.0, "T2": 180.0, "T3": 150.0, "T4": 100.0, "MCL": 15.0, "ACL": 5.0, "PCL": 3.0}


def source(kind: str = "predicted", **values: float | None) -> SourceReport:
    """Return a source with good values, apart from those given."""
    merged = GOOD | values
    found = [PointValue(id=i, value=v, unit=UNITS.get(i, "N·m")) for i, v in merged.items()]
    return SourceReport(kind=kind, label=f"<{kind}>", values=found, decides=True)


def point(name: str, across: float, *sources: SourceReport, relaxed: bool = False) -> PointReport:
    """Return a point of which the first source decides."""
    told = [each.model_copy(update={"decides": i == 0}) for i, each in enumerate(sources)]
    return PointReport(name=name, across=across, height=500.0, relaxed=relaxed, sources=told)


def terms(scheme: str, **asked: object) -> SchemeTerms:
    """Return a shipped scheme with its corridor set."""
    found = load("scheme", scheme).document
    corridors = load("corridors", found.corridors).document
    return SchemeTerms(found, corridors, **asked)


def carried() -> list[InputFile]:
    """Return the definitions that the campaign rests on."""
    found = [
        InputFile(role="campaign", path="car.yaml", sha256=sha256(SHEET.encode()).hexdigest(), text=SHEET)
    ]
    for kind, name in (("scheme", "r127"), ("corridors", "r127-vehicle"), ("scheme", "euro-ncap-flex-pli")):
        each = load(kind, name)
        found.append(InputFile(role=kind, path=each.path, sha256=each.sha256, text=each.text))
    return found


def campaign() -> CampaignReport:
    """Return a campaign with every kind of source, with points that pass, fail and are not known."""
    points = [
        point("L-2", -200.0, source("predicted")),
        point("L-1", -100.0, source("measured", T1=330.0), source("predicted")),
        point("L0", 0.0, source("measured", MCL=23.0), source("lumped")),
        point("L+1", 100.0, source("lumped"), relaxed=True),
        point("L+2", 200.0, source("finite elements")),
        point("=L+3", 300.0),
    ]
    asked = [terms("r127"), terms("euro-ncap-flex-pli", at_least=5.0)]
    asked.append(SchemeTerms(asked[0].scheme, asked[0].corridors, 0.8, own_targets=True))
    return worded(
        CampaignReport(
            campaign="made-up",
            title="A <made-up> car",
            verdict="fail",
            car=CarFront(name="Car", width=1800, height=1450, bonnet_edge=750, bumper=500, zones=[(50, 150)]),
            schemes=[judge_car(each, points, symmetric=True) for each in asked],
            points=points,
            agreement=agreement(points, set(GOOD), 10.0),
            tolerance_percent=10.0,
            remarks=["something to know"],
            provenance=Provenance(certkit="0.2.0", inputs=carried(), packages={}),
        )
    ).with_id()
