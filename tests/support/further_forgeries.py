"""More certificates forged in one way each: what PDFs hide, look-alikes, what JSON allows, other versions."""

from __future__ import annotations

import hashlib
import json
import re
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import pikepdf

import certkit
from support.forgeries import Forgery, changed, criterion, pdf, scaled, top

if TYPE_CHECKING:
    from collections.abc import Callable

    from certkit.documents.result import Result


def text(change: Callable[[str], str]) -> Callable[[Result], str]:
    """Change the text of a document, which then is as its forger wants it."""
    return lambda result: change(result.to_json())


def _twice(given: str) -> str:
    """Say a second verdict before the one that counts: other readers take the first."""
    return given.replace('"verdict":', '"verdict":"fail","verdict":', 1)


def _older(result: Result, version: str = "0.1.0") -> Result:
    return changed(result, provenance=result.provenance.model_copy(update={"certkit": version}))


def _other_recording(result: Result) -> Result:
    inputs = [
        item.model_copy(update={"sha256": "ab" * 32}) if item.role == "recording" else item
        for item in result.provenance.inputs
    ]
    return changed(result, provenance=result.provenance.model_copy(update={"inputs": inputs}))


def _other_package(result: Result) -> Result:
    packages = {**result.provenance.packages, "numpy": "0.0.1"}
    return changed(result, provenance=result.provenance.model_copy(update={"packages": packages}))


LOOK_ALIKE = "r127-реndulum"  # its p and e are Cyrillic


def _info(opened: pikepdf.Pdf) -> None:
    opened.docinfo["/Title"] = "Passed: accredited certificate"


def _xmp(opened: pikepdf.Pdf) -> None:
    stream = opened.Root.Metadata
    packet = stream.read_bytes()
    stream.write(re.sub(rb"(<dc:title>.*?<rdf:li[^>]*>)[^<]*", rb"\1Passed", packet, flags=re.DOTALL))


def _outline(opened: pikepdf.Pdf) -> None:
    with opened.open_outline() as outline:
        outline.root.append(pikepdf.OutlineItem("Verdict: PASS", 0))


def _spoken(opened: pikepdf.Pdf) -> None:
    """Say other words to whoever has the page read aloud."""
    marked = next(
        each
        for each in opened.objects
        if isinstance(each, pikepdf.Dictionary) and "/S" in each and "/P" in each
    )
    marked.Alt = "The verdict is PASS"


def _described(opened: pikepdf.Pdf) -> None:
    for each in opened.objects:
        if isinstance(each, pikepdf.Dictionary) and each.get("/Type") == "/Filespec":
            each.Desc = "approved"


def _label(opened: pikepdf.Pdf) -> None:
    opened.Root.PageLabels = pikepdf.Dictionary(Nums=[0, pikepdf.Dictionary(P="PASS ")])


def _invisible(opened: pikepdf.Pdf) -> None:
    font = next(iter(opened.pages[0].Resources.Font.keys()))
    words = b"BT 3 Tr %s 9 Tf 60 700 Td <0001000200030004> Tj ET" % font.encode()
    opened.pages[0].contents_add(opened.make_stream(words), prepend=False)


def _glyphs(opened: pikepdf.Pdf) -> None:
    """Let the text of the page read otherwise than its glyphs."""
    for each in opened.objects:
        if isinstance(each, pikepdf.Dictionary) and each.get("/Type") == "/Font" and "/ToUnicode" in each:
            table = each.ToUnicode.read_bytes()
            each.ToUnicode.write(re.sub(rb"<0061>|<0065>", b"<0078>", table))


def _fonts(opened: pikepdf.Pdf) -> None:
    """Draw one font with the outlines of another."""
    found = [
        each
        for each in opened.objects
        if isinstance(each, pikepdf.Dictionary) and each.get("/Type") == "/FontDescriptor"
    ]
    files = [(each, key) for each in found for key in ("/FontFile2", "/FontFile3") if key in each]
    (first, key), (second, other) = files[0], files[-1]
    first[key], second[other] = second[other], first[key]


def _crop(opened: pikepdf.Pdf) -> None:
    opened.pages[0].CropBox = [0, 420, 595.3, 841.9]


def _turn(opened: pikepdf.Pdf) -> None:
    opened.pages[0].Rotate = 180


def _unit(opened: pikepdf.Pdf) -> None:
    opened.pages[0].UserUnit = 2.0


def _identity(opened: pikepdf.Pdf) -> None:
    opened.trailer.ID = pikepdf.Array([pikepdf.String("0" * 16), pikepdf.String("1" * 16)])


def _faint(opened: pikepdf.Pdf) -> None:
    opened.pages[0].contents_add(opened.make_stream(b"0.995 g 60 660 200 60 re f"), prepend=True)


def _hidden_object(opened: pikepdf.Pdf) -> None:
    """Put aside a page for a later update."""
    opened.Root.PieceInfo = pikepdf.Dictionary(
        Later=pikepdf.Dictionary(Private=opened.make_stream(b"0 0.6 0 rg 60 660 200 60 re f"))
    )


def _two_of_one_name(opened: pikepdf.Pdf) -> None:
    names = opened.Root.Names.EmbeddedFiles.Names
    names.insert(0, pikepdf.AttachedFileSpec(opened, b"{}", filename="result.json").obj)
    names.insert(0, pikepdf.String("result.json"))


def _picture(opened: pikepdf.Pdf, colour: bytes) -> pikepdf.Stream:
    """Make a picture of one dot."""
    made = opened.make_stream(colour)
    made.Type, made.Subtype = pikepdf.Name.XObject, pikepdf.Name.Image
    made.Width, made.Height, made.BitsPerComponent, made.ColorSpace = 1, 1, 8, pikepdf.Name.DeviceRGB
    return made


def _alternate(opened: pikepdf.Pdf) -> None:
    seal = _picture(opened, b"\xff\xff\xff")
    printed = pikepdf.Dictionary(Image=_picture(opened, b"\x00\xff\x00"), DefaultForPrinting=True)
    seal.Alternates = pikepdf.Array([printed])
    resources = opened.pages[0].Resources
    resources.XObject = resources.get("/XObject", pikepdf.Dictionary())
    resources.XObject["/Seal"] = seal
    opened.pages[0].contents_add(opened.make_stream(b"q 1 0 0 1 300 400 cm /Seal Do Q"), prepend=False)


def _thumbnail(opened: pikepdf.Pdf) -> None:
    opened.pages[0].Thumb = _picture(opened, b"\x00\xff\x00")


def _by_another_engine(operators: bytes) -> Callable[[pikepdf.Pdf], None]:
    """Paint, and say that another WeasyPrint has made the pages: its version is no part of the id."""

    def change(opened: pikepdf.Pdf) -> None:
        held = {name: opened.attachments[name].get_file().read_bytes() for name in opened.attachments}
        result = re.sub(rb'"weasyprint":"[^"]*"', b'"weasyprint":"1.0"', held["result.json"])
        old, new = (hashlib.sha256(each).hexdigest().encode() for each in (held["result.json"], result))
        manifest = held["manifest.json"].replace(old, new)
        for name, content in (("result.json", result), ("manifest.json", manifest)):
            opened.attachments[name] = pikepdf.AttachedFileSpec(opened, content, filename=name)
        opened.pages[0].contents_add(opened.make_stream(operators), prepend=False)

    return change


def _look_alike(result: Result) -> Result:
    """Grade by wider corridors whose names and procedure look like the shipped ones."""
    del result
    root = Path(__file__).parents[2]
    with tempfile.TemporaryDirectory() as folder:
        for kind, name, old, new in (
            ("corridors", "r127-pendulum", "235 N·m", "225 N·m"),
            ("procedures", "pendulum", "procedure: pendulum", f"procedure: {LOOK_ALIKE[5:]}"),
        ):
            text = (root / kind / f"{name}.yaml").read_text("utf-8")
            text = text.replace(old, new).replace("r127-pendulum", LOOK_ALIKE)
            path = Path(folder, kind, name.replace("pendulum", LOOK_ALIKE[5:]) + ".yaml")
            path.parent.mkdir()
            path.write_text(text, "utf-8")
        data = root / "examples" / "measured"
        test, lab = data / "FLX-0007-pendulum.zip", data / "lab.yaml"
        return certkit.grade(LOOK_ALIKE[5:], test, laboratory=lab, library=folder).as_written()


def _old_table(content: bytes) -> bytes:
    """Append another catalogue and let the last line point to the old table: repairing readers take it."""
    place = re.findall(rb"startxref\s+(\d+)", content)[-1]
    return content + b"9999 0 obj\n<< /Type /Catalog >>\nendobj\nstartxref\n%s\n%%%%EOF\n" % place


DOCUMENTS = [
    Forgery("a key twice", "measured", text(_twice), "bytes|damaged"),
    Forgery(
        "not a number",
        "measured",
        text(lambda given: re.sub(r'"margin":[-0-9.]+', '"margin":NaN', given, count=1)),
        "refused",
    ),
    Forgery(
        "infinity by its exponent",
        "measured",
        text(lambda given: re.sub(r'"upper":[-0-9.]+', '"upper":1e999', given, count=1)),
        "refused",
    ),
    Forgery(
        "number as a word",
        "measured",
        text(lambda given: re.sub(r'"upper":([-0-9.]+)', r'"upper":"\1"', given, count=1)),
        "bytes",
    ),
    Forgery(
        "keys in another order",
        "measured",
        text(lambda given: json.dumps(dict(reversed(list(json.loads(given).items()))))),
        "bytes",
    ),
    Forgery("other white space", "measured", text(lambda given: given.replace("\n", "\n ")), "bytes"),
    Forgery("byte order mark", "measured", text(lambda given: "\ufeff" + given), "refused|bytes"),
    Forgery("text behind the end", "measured", text(lambda given: given + "{}"), "refused"),
    Forgery(
        "older schema",
        "measured",
        text(lambda g: g.replace("certkit-result/1", "certkit-result/0")),
        "refused",
    ),
    Forgery(
        "field of its own", "measured", text(lambda g: g.replace("{", '{"approved":"yes",', 1)), "refused"
    ),
    Forgery(
        "title with a look-alike letter",
        "measured",
        top(title="Dynamiс certification, pendulum test"),
        "title",
    ),
    Forgery(
        "title with a turning mark", "measured", top(title="\u202eDynamic certification"), "title|refused"
    ),
    Forgery("corridors under a look-alike name", "measured", _look_alike, "look-alike-name"),
    Forgery(
        "older version claimed, value changed",
        "measured",
        lambda r: _older(criterion("T1", value=254.5)(r)),
        "graded again: T1",
    ),
    Forgery(
        "older version claimed, simulated",
        "simulated",
        lambda r: _older(scaled("channels", "F1", 0.995)(r)),
        "reproduction|graded again",
    ),
    Forgery(
        "simulated as finite elements",
        "simulated",
        top(kind="virtual test"),
        "graded again|kind|reproduction",
    ),
    Forgery(
        "criterion twice",
        "measured",
        lambda r: changed(r, criteria=type(r.criteria)([*r.criteria, r.criteria[0]])),
        "refused|graded again",
    ),
]


PAPERS = [
    Forgery("title in the file's properties", "pdf", pdf(_info), "^file.*words-added"),
    Forgery("title in the XMP metadata", "pdf", pdf(_xmp), "^file.*words-added"),
    Forgery("bookmark", "pdf", pdf(_outline), "^file.*words-added"),
    Forgery("words for screen readers", "pdf", pdf(_spoken), "^file.*words-added"),
    Forgery("description of an attachment", "pdf", pdf(_described), "^file.*words-added"),
    Forgery("page labels", "pdf", pdf(_label), "^file.*words-added"),
    Forgery("invisible words", "pdf", pdf(_invisible), "^pages.*page-text"),
    Forgery("text that reads otherwise than it looks", "pdf", pdf(_glyphs), "^pages.*page-text"),
    Forgery("glyphs of another font", "pdf", pdf(_fonts), "^pages.*page-(text|picture)"),
    Forgery("cropped page", "pdf", pdf(_crop), "^pages.*page-size"),
    Forgery("turned page", "pdf", pdf(_turn), "^pages.*page-"),
    Forgery("larger unit of length", "pdf", pdf(_unit), "^file.*active-content"),
    Forgery("identifier of the file", "pdf", pdf(_identity), "^pages.*pages-rewritten"),
    Forgery("faint area behind the text", "pdf", pdf(_faint), "^pages.*page-picture"),
    Forgery("content put aside for later", "pdf", pdf(_hidden_object), "^file.*active-content"),
    Forgery("two attachments of one name", "pdf", pdf(_two_of_one_name), "refused"),
    Forgery(
        "another picture when printed", "pdf", pdf(_alternate), "^(file.*active-content|pages.*page-picture)"
    ),
    Forgery("another picture in the list of pages", "pdf", pdf(_thumbnail), "^file.*active-content"),
    Forgery(
        "watermark, by another WeasyPrint",
        "pdf",
        pdf(_by_another_engine(b"0.8 g 60 660 200 60 re f")),
        "^pages.*other-engine",
    ),
    Forgery(
        "another colour of one grey, by another WeasyPrint",
        "pdf",
        pdf(_by_another_engine(b"1 1 0.995 rg 300 20 40 5 re f")),
        "^pages.*other-engine",
    ),
    Forgery("update behind the old table", "pdf", _old_table, "^file.*update-appended"),
    Forgery("bytes before the beginning", "pdf", lambda c: b"<html>PASS</html>\n" + c, "^file.*bytes-before"),
]

OUTSIDE: list[tuple[Forgery, str]] = [
    (
        Forgery("hash of another recording, which is not at hand", "measured", _other_recording, ""),
        "The hash is compared with the recording's when that is named beside the certificate.",
    ),
    (
        Forgery("another version of certkit", "measured", _older, ""),
        "Where two versions come to the same document, nothing tells them apart.",
    ),
    (
        Forgery("version of a package", "measured", _other_package, ""),
        "They are no part of the id, since the same test has one id in every environment.",
    ),
]
"""What `verify` does not promise to name, and why."""
