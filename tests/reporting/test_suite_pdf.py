from __future__ import annotations

import io
from collections.abc import Iterator

import pikepdf
import pytest
from msgspec.structs import replace
from support import synthetic_result

from certkit.reporting.pdf_report import certificate
from certkit.reporting.result_view import View, unique_views


@pytest.fixture(scope="module")
def views() -> list[View]:
    results = [synthetic_result.result(), synthetic_result.static_result()]
    return [replace(view, pdf=certificate([view])) for view in unique_views(results)]


@pytest.fixture(scope="module")
def made(views: list[View]) -> bytes:
    return certificate(views, title="Two tests")


@pytest.fixture(scope="module")
def suite(made: bytes) -> Iterator[pikepdf.Pdf]:
    with pikepdf.open(io.BytesIO(made)) as document:
        yield document


@pytest.fixture(scope="module")
def single(views: list[View]) -> Iterator[list[pikepdf.Pdf]]:
    documents = [pikepdf.open(io.BytesIO(view.pdf or b"")) for view in views]
    yield documents
    for document in documents:
        document.close()


def elements(element: pikepdf.Object) -> Iterator[pikepdf.Object]:
    """Walk through the structure tree."""
    if isinstance(element, pikepdf.Array):
        for child in element:
            yield from elements(child)
    elif isinstance(element, pikepdf.Dictionary):
        yield element
        if "/K" in element and element.get("/Type") != "/MCR":
            yield from elements(element.K)


def test_certificates_that_were_set_are_bound_as_certificates_set_anew(views: list[View], made: bytes):
    assert certificate([replace(view, pdf=None) for view in views], title="Two tests") == made


def test_its_pages_are_the_contents_and_then_those_of_the_certificates(
    suite: pikepdf.Pdf, single: list[pikepdf.Pdf]
):
    pages = [page.Contents.read_bytes() for document in single for page in document.pages]
    assert [page.Contents.read_bytes() for page in suite.pages][1:] == pages


def test_every_page_and_link_finds_its_elements_in_one_structure(suite: pikepdf.Pdf):
    numbers = list(suite.Root.StructTreeRoot.ParentTree.Nums)[::2]
    asked = [int(page.StructParents) for page in suite.pages]
    asked += [int(link.StructParent) for page in suite.pages for link in page.get("/Annots", [])]
    assert [int(number) for number in numbers] == list(range(len(numbers)))
    assert sorted(asked) == list(range(len(numbers)))
    assert [str(part.S) for part in suite.Root.StructTreeRoot.K[0].K][-2:] == ["/Part", "/Part"]


def test_elements_of_a_certificate_stand_on_its_own_pages(suite: pikepdf.Pdf, single: list[pikepdf.Pdf]):
    first = 1
    for part, document in zip(suite.Root.StructTreeRoot.K[0].K[-2:], single, strict=True):
        own = {page.objgen for page in suite.pages[first : first + len(document.pages)]}
        assert {element.Pg.objgen for element in elements(part) if "/Pg" in element} <= own
        first += len(document.pages)


def test_no_two_heads_of_tables_have_one_name(suite: pikepdf.Pdf):
    names = [str(each.ID) for each in elements(suite.Root.StructTreeRoot.K) if "/ID" in each]
    assert len(names) > 20
    assert len(set(names)) == len(names)


def test_bookmarks_lead_to_the_contents_and_to_each_certificate(
    suite: pikepdf.Pdf, single: list[pikepdf.Pdf]
):
    with suite.open_outline() as outline:
        titles = [item.title for item in outline.root]
        places = [item.destination[0].objgen for item in outline.root]
    assert titles == ["Two tests", *(synthetic_result.result().title, synthetic_result.static_result().title)]
    firsts = [0, 1, 1 + len(single[0].pages)]
    assert places == [suite.pages[number].objgen for number in firsts]


def test_lines_of_the_contents_lead_to_the_pages_that_they_name(
    suite: pikepdf.Pdf, single: list[pikepdf.Pdf]
):
    second = 1 + len(single[0].pages)
    targets = [link.Dest[0].objgen for link in suite.pages[0].Annots]
    assert set(targets) == {suite.pages[1].objgen, suite.pages[second].objgen}


def test_a_page_is_labelled_by_its_certificate_and_its_number_in_it(suite: pikepdf.Pdf):
    assert [page.label for page in suite.pages][:3] == ["1", "pendulum 1", "pendulum 2"]
    assert suite.pages[-1].label.startswith("static-femur ")


def test_it_carries_what_the_certificates_carry_by_sorted_names(
    suite: pikepdf.Pdf, single: list[pikepdf.Pdf]
):
    keys = ["pendulum", "static-femur"]
    wanted = {
        f"{key}-{name}" for key, document in zip(keys, single, strict=True) for name in document.attachments
    }
    names = [str(name) for name in suite.Root.Names.EmbeddedFiles.Names[::2]]
    assert set(names) == wanted | {"manifest.json"}
    assert names == sorted(names)
    assert len(suite.Root.AF) == len(names)
    for key, document in zip(keys, single, strict=True):
        for name, file in document.attachments.items():
            taken = suite.attachments[f"{key}-{name}"]
            assert taken.get_file().read_bytes() == file.get_file().read_bytes()
            assert taken.obj.AFRelationship == file.obj.AFRelationship


def test_it_says_to_be_pdf_a_3a(suite: pikepdf.Pdf):
    with suite.open_metadata() as metadata:
        assert (metadata["pdfaid:part"], metadata["pdfaid:conformance"]) == ("3", "A")
    assert suite.Root.MarkInfo.Marked
    assert suite.Root.OutputIntents[0].S == "/GTS_PDFA1"


def test_more_reports_than_a_page_lists_are_counted_from_behind_the_contents():
    results = [
        synthetic_result.static_result().model_copy(update={"procedure": f"bone-{n}"}) for n in range(16)
    ]
    pdf = certificate(unique_views(results[:1]))
    many = [replace(view, pdf=pdf) for view in unique_views(results)]
    with pikepdf.open(io.BytesIO(certificate(many, title="Many tests"))) as suite:
        assert suite.pages[2].label == "bone-0 1"
        assert suite.pages[0].Annots[0].Dest[0].objgen == suite.pages[2].objgen
