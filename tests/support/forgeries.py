"""Certificates forged in one way each: documents, folders and PDFs, with what `verify` has to name.

A forger knows certkit: where nothing else is said, the id and all hashes are made anew, so that the document
is whole. What verify says is told as part of the check's name, or of its code.
"""

from __future__ import annotations

import hashlib
import io
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import pikepdf

from certkit.bench.verify import verify
from certkit.errors import CertkitError

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from certkit.documents.result import Result

Change = dict[str, Any]


@dataclass(frozen=True)
class Forgery:
    """One way to forge.

    Parameters
    ----------
    name : str
    kind : {'measured', 'simulated', 'pdf'}
        Which genuine certificate it begins with: that of a measured test, of a simulated one, or the PDF of
        the measured one.
    do : callable
        From the genuine result or the PDF's bytes to the forged ones.
    named : str
        Regular expression that a check which does not hold, or could not be made, has to match: its name and
        code.
    """

    name: str
    kind: str
    do: Callable[[Any], Any]
    named: str


def changed(result: Result, **fields: object) -> Result:
    """Return a result with other fields and its id made anew."""
    return result.model_copy(update=fields).with_id()


def top(**fields: object) -> Callable[[Result], Result]:
    """Change fields of the document."""
    return lambda result: changed(result, **fields)


def criterion(name: str, **fields: object) -> Callable[[Result], Result]:
    """Change fields of one criterion."""

    def do(result: Result) -> Result:
        rows = [c.model_copy(update=fields) if c.id == name else c for c in result.criteria]
        return changed(result, criteria=type(result.criteria)(rows))

    return do


def nested(field: str, **fields: object) -> Callable[[Result], Result]:
    """Change fields of a part of the document."""
    return lambda result: changed(result, **{field: getattr(result, field).model_copy(update=fields)})


def definition(role: str, old: str, new: str, *, path: str | None = None) -> Callable[[Result], Result]:
    """Change the text of a carried definition, its hash, and if wanted its path."""

    def do(result: Result) -> Result:
        inputs = []
        for item in result.provenance.inputs:
            text = item.text
            if item.role == role and text is not None and old in text:
                text = text.replace(old, new)
                digest = hashlib.sha256(text.encode()).hexdigest()
                update: Change = {"text": text, "sha256": digest} | ({"path": path} if path else {})
                inputs.append(item.model_copy(update=update))
            else:
                inputs.append(item)
        assert inputs != list(result.provenance.inputs), f"{old} is in no {role}"
        return changed(result, provenance=result.provenance.model_copy(update={"inputs": inputs}))

    return do


def scaled(field: str, channel: str, factor: float) -> Callable[[Result], Result]:
    """Scale one series of the drawn curves, the channels or the energies."""

    def do(result: Result) -> Result:
        part = getattr(result, field)
        series = part.series[channel]
        other = series.model_copy(update={"values": [factor * value for value in series.values]})
        return changed(result, **{field: part.model_copy(update={"series": {**part.series, channel: other}})})

    return do


def in_sequence(*steps: Callable[[Result], Result]) -> Callable[[Result], Result]:
    """Forge in several steps."""

    def do(result: Result) -> Result:
        for step in steps:
            result = step(result)
        return result

    return do


def _measured_as_simulated(result: Result) -> Result:
    return changed(result, kind="virtual certification")


def _simulated_as_measured(result: Result) -> Result:
    return changed(result, kind="test evaluation")


def _simulated_as_measured_with_care(result: Result) -> Result:
    return changed(
        result, kind="test evaluation", quality=None, energies=None, motion=None, front=None, specimen={}
    )


def _serial(result: Result) -> Result:
    laboratory = {**(result.laboratory or {}), "item": {**result.laboratory["item"], "serial": "FLX-9999"}}
    return changed(result, laboratory=laboratory)


def _hidden_override(result: Result) -> Result:
    """Pretend that the changed values were the definitions' own."""
    return changed(result, provenance=result.provenance.model_copy(update={"overrides": []}))


def _precondition(result: Result) -> Result:
    rows = [p.model_copy(update={"value": p.lower}) if p.lower else p for p in result.preconditions]
    return changed(result, preconditions=rows)


def _note(result: Result) -> Result:
    return changed(result, notes=result.notes[1:], coded_notes=result.coded_notes[1:])


def _gate(result: Result) -> Result:
    checks = [
        c.model_copy(update={"limit": 100.0, "value": 80.0}) if i == 0 else c
        for i, c in enumerate(result.quality.checks)
    ]
    return changed(result, quality=result.quality.model_copy(update={"checks": checks}))


def _penetration(result: Result) -> Result:
    return changed(result, quality=result.quality.model_copy(update={"penetration_mm": 0.001}))


DOCUMENTS = [
    Forgery("verdict, id left", "measured", lambda r: r.model_copy(update={"verdict": "fail"}), "id-differs"),
    Forgery("verdict", "measured", top(verdict="conditional"), "graded again: verdict"),
    Forgery("value of a criterion", "measured", criterion("T1", value=268.0), "graded again: T1"),
    Forgery("margin of a criterion", "measured", criterion("T1", margin=99.0), "graded again: T1"),
    Forgery("limit of a criterion", "measured", criterion("T2", upper=260.0), "graded again: T2"),
    Forgery("verdict of a criterion", "measured", criterion("T3", verdict="fail"), "graded again: T3"),
    Forgery("confidence", "measured", criterion("T1", confidence="derived"), "graded again: T1"),
    Forgery("source of a corridor", "measured", criterion("T1", source="a better text"), "graded again: T1"),
    Forgery("criterion made informative", "measured", criterion("T4", graded=False), "graded again: T4"),
    Forgery("time of the peak", "measured", criterion("T1", time=0.001), "graded again: T1"),
    Forgery("filter", "measured", criterion("T1", filter="none"), "graded again: T1"),
    Forgery(
        "criterion left out",
        "measured",
        lambda r: changed(r, criteria=type(r.criteria)([c for c in r.criteria if c.id != "PCL"])),
        "graded again: PCL",
    ),
    Forgery("remarks", "measured", top(remarks=[], coded_remarks=[]), "graded again: .*remarks"),
    Forgery("remark in words alone", "measured", top(remarks=["All is well."]), "words-differ|remarks"),
    Forgery("title", "measured", top(title="Accredited test"), "graded again: title"),
    Forgery("method", "measured", top(method="ISO 17025"), "graded again: method"),
    Forgery("specimen", "measured", top(specimen={"legform": "another"}), "graded again: specimen"),
    Forgery("decision rule", "measured", top(decision_rule="simple acceptance"), "decision.rule|words"),
    Forgery("preconditions left out", "measured", top(preconditions=[]), "graded again: preconditions"),
    Forgery("preconditions met", "measured", _precondition, "graded again: preconditions"),
    Forgery("serial number", "measured", _serial, "graded again: laboratory"),
    Forgery("laboratory left out", "measured", top(laboratory=None), "graded again: laboratory"),
    Forgery("drawn curve", "measured", scaled("curves", "T1", 0.5), "graded again: curves"),
    Forgery("recorded channel", "measured", scaled("channels", "T1", 0.98), "graded again: T1"),
    Forgery("note left out", "measured", _note, "graded again: notes"),
    Forgery("conditions", "measured", top(conditions={}), "graded again: "),
    Forgery("parameters", "simulated", top(parameters=[]), "graded again: .*(parameters|remarks)"),
    Forgery("measured as simulated", "measured", _measured_as_simulated, "graded again: "),
    Forgery("simulated as measured", "simulated", _simulated_as_measured, "^kind"),
    Forgery("simulated as measured, with care", "simulated", _simulated_as_measured_with_care, "^kind"),
    Forgery("widened corridor", "measured", definition("corridors", "235 N·m", "135 N·m"), "limits-differ"),
    Forgery(
        "widened corridor throughout",
        "measured",
        in_sequence(definition("corridors", "235 N·m", "225 N·m"), criterion("T1", lower=225.0)),
        "limits-differ",
    ),
    Forgery(
        "narrower filter in the procedure",
        "measured",
        definition("procedure", "CFC 180", "CFC 60"),
        "claims-to-be-shipped|graded again",
    ),
    Forgery(
        "stiffer leg in the legform's file",
        "simulated",
        definition("legform", "bending stiffness: ", "bending stiffness: 1"),
        "reproduction|claims-to-be-shipped",
    ),
    Forgery("hidden override", "simulated overridden", _hidden_override, "reproduction"),
    Forgery("simulated value", "simulated", scaled("channels", "F1", 0.5), "reproduction"),
    Forgery("energies", "simulated", scaled("energies", "kinetic", 0.5), "reproduction"),
    Forgery("motion", "simulated", nested("motion", unit="kN·m"), "reproduction"),
    Forgery("gate with another limit", "simulated", _gate, "quality|reproduction"),
    Forgery("quality of the run", "simulated", _penetration, "quality|reproduction"),
    Forgery("quality left out", "simulated", top(quality=None), "reproduction"),
    Forgery("number of steps", "simulated", nested("quality", steps=7), "reproduction"),
]


def pdf(change: Callable[[pikepdf.Pdf], None]) -> Callable[[bytes], bytes]:
    """Change a PDF with an editor that writes it anew."""

    def do(content: bytes) -> bytes:
        target = io.BytesIO()
        with pikepdf.open(io.BytesIO(content)) as opened:
            change(opened)
            opened.save(target)
        return target.getvalue()

    return do


def _paint(operators: bytes) -> Callable[[pikepdf.Pdf], None]:
    def change(pdf: pikepdf.Pdf) -> None:
        pdf.pages[0].contents_add(pdf.make_stream(operators), prepend=False)

    return change


def _annotate(subtype: str, **further: object) -> Callable[[pikepdf.Pdf], None]:
    def change(pdf: pikepdf.Pdf) -> None:
        form = pdf.make_stream(b"0 1 0 rg 0 0 200 60 re f")
        form.Type, form.Subtype, form.BBox = pikepdf.Name.XObject, pikepdf.Name.Form, [0, 0, 200, 60]
        made = pikepdf.Dictionary(
            Type=pikepdf.Name.Annot,
            Subtype=pikepdf.Name(f"/{subtype}"),
            Rect=[60, 660, 260, 720],
            F=4,
            AP=pikepdf.Dictionary(N=form),
            **further,
        )
        pdf.pages[0].Annots = pdf.make_indirect(pikepdf.Array([pdf.make_indirect(made)]))

    return change


def _field(pdf: pikepdf.Pdf) -> None:
    _annotate("Widget", FT=pikepdf.Name.Tx, T="verdict", V="PASS")(pdf)
    pdf.Root.AcroForm = pikepdf.Dictionary(Fields=pikepdf.Array([pdf.pages[0].Annots[0]]))


def _script(pdf: pikepdf.Pdf) -> None:
    pdf.Root.OpenAction = pikepdf.Dictionary(S=pikepdf.Name.JavaScript, JS="app.alert('PASS')")


def _layer(pdf: pikepdf.Pdf) -> None:
    group = pdf.make_indirect(pikepdf.Dictionary(Type=pikepdf.Name.OCG, Name="verdict"))
    groups = pikepdf.Array([group])
    pdf.Root.OCProperties = pikepdf.Dictionary(OCGs=groups, D=pikepdf.Dictionary(ON=groups))
    _paint(b"/OC /verdict BDC 1 g 60 660 200 60 re f EMC")(pdf)


def _blank(pdf: pikepdf.Pdf) -> None:
    pdf.add_blank_page(page_size=(595.3, 841.9))


def _foreign(pdf: pikepdf.Pdf) -> None:
    with pikepdf.new() as other:
        other.add_blank_page(page_size=(595.3, 841.9))
        other.pages[0].contents_add(other.make_stream(b"0 g 100 100 200 200 re f"))
        pdf.pages.append(other.pages[0])


def _less(pdf: pikepdf.Pdf) -> None:
    del pdf.pages[-1]


def _swapped(pdf: pikepdf.Pdf) -> None:
    pdf.pages.reverse()


def _cut(pdf: pikepdf.Pdf) -> None:
    pdf.pages[0].MediaBox = [0, 100, 595.3, 841.9]


def _attachment(name: str, content: bytes | None) -> Callable[[pikepdf.Pdf], None]:
    def change(pdf: pikepdf.Pdf) -> None:
        if content is None:
            del pdf.attachments[name]
        else:
            pdf.attachments[name] = pikepdf.AttachedFileSpec(pdf, content, filename=name)

    return change


def _updated(content: bytes) -> bytes:
    """Put a page's other content into an incremental update, as any editor does."""
    with pikepdf.open(io.BytesIO(content)) as pdf:
        root, size = pdf.Root.objgen[0], int(pdf.trailer.Size)
        page = pdf.pages[0].obj
        number = page.objgen[0]
        page.Contents = pdf.make_stream(b"1 g 0 0 600 850 re f 0 0.6 0 rg 60 660 200 60 re f")
        body = page.unparse(resolved=True)
        picture = page.Contents.read_raw_bytes()
    body = re.sub(rb"/Contents \d+ 0 R", b"/Contents %d 0 R" % size, body)
    first = len(content)
    parts = b"%d 0 obj\n%s\nendobj\n" % (number, body)
    second = first + len(parts)
    parts += b"%d 0 obj\n<< /Length %d >>\nstream\n%s\nendstream\nendobj\n" % (size, len(picture), picture)
    table = first + len(parts)
    before = int(re.findall(rb"startxref\s+(\d+)", content)[-1])
    parts += b"xref\n%d 1\n%010d 00000 n \n%d 1\n%010d 00000 n \n" % (number, first, size, second)
    parts += b"trailer\n<< /Size %d /Root %d 0 R /Prev %d >>\n" % (size + 1, root, before)
    return content + parts + b"startxref\n%d\n%%%%EOF\n" % table


PAPERS = [
    Forgery("bytes after the end", "pdf", lambda c: c + b"\n" * 9 + b"trust me", "^file.*bytes-appended"),
    Forgery("incremental update", "pdf", _updated, "^file.*update-appended"),
    Forgery("painted over", "pdf", pdf(_paint(b"1 g 60 660 200 60 re f")), "^pages.*page-picture"),
    Forgery("thin line", "pdf", pdf(_paint(b"0.9 G 60 660 m 90 660 l S")), "^pages.*page-picture"),
    Forgery("blank page", "pdf", pdf(_blank), "^pages.*page-blank"),
    Forgery("foreign page", "pdf", pdf(_foreign), "^pages.*page-count"),
    Forgery("page left out", "pdf", pdf(_less), "^pages.*page-count"),
    Forgery("pages in another order", "pdf", pdf(_swapped), "^pages.*page-text"),
    Forgery("cut page", "pdf", pdf(_cut), "^pages.*page-size"),
    Forgery("stamp", "pdf", pdf(_annotate("Stamp")), "^file.*annotation"),
    Forgery("square", "pdf", pdf(_annotate("Square")), "^file.*annotation"),
    Forgery("form field", "pdf", pdf(_field), "^file.*form-field"),
    Forgery("script", "pdf", pdf(_script), "^file.*active-content"),
    Forgery("layer", "pdf", pdf(_layer), "^file.*active-content"),
    Forgery("attachment added", "pdf", pdf(_attachment("note.txt", b"trust me")), "attached-not-listed"),
    Forgery("attachment left out", "pdf", pdf(_attachment("channels.csv", None)), "listed-not-attached"),
    Forgery("attachment changed", "pdf", pdf(_attachment("lab.yaml", b"x")), "attached-not-listed"),
    Forgery("written by another program", "pdf", pdf(lambda _: None), "^pages.*pages-rewritten"),
]


def forged(forgery: Forgery, genuine: Result | bytes, folder: Path) -> Path:
    """Write a forged certificate; return its file."""
    made = forgery.do(genuine)
    path = folder / ("report.pdf" if forgery.kind == "pdf" else "result.json")
    text = made if isinstance(made, str | bytes) else made.to_json()
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def told_of(path: Path) -> tuple[str, list[tuple[str, str, str]]]:
    """Return what `verify` comes to; of each check that does not hold its name, code and words."""
    try:
        found = verify(path)
    except CertkitError as error:
        return "refused", [("refused", "", str(error).replace(str(path), path.name))]
    return found.outcome, [(c.what, c.code, c.said) for c in found.checks if c.asked and not c.holds]
