"""A certificate holds as long as nothing in it was changed and it grades to the same verdict again."""

from __future__ import annotations

import hashlib
import io
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import certkit
from certkit.bench.verify import verify
from certkit.definitions.loading.library import names
from certkit.documents.result import Result
from certkit.errors import CertkitError, DataError

pikepdf = pytest.importorskip("pikepdf")

DATA = Path(__file__).parents[2] / "examples" / "measured"


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a graded measured test, with all reports."""
    folder = tmp_path_factory.mktemp("verify") / "run"
    result = certkit.grade("pendulum", DATA / "FLX-0007-pendulum.zip", laboratory=DATA / "lab.yaml")
    certkit.render(result, folder, ["html", "pdf", "junit", "csv", "md"])
    return folder


def copied(run: Path, target: Path) -> Path:
    target.mkdir(parents=True)
    for path in run.iterdir():
        if path.suffix == ".pdf":
            continue
        (target / path.name).write_bytes(path.read_bytes())
    return target


def broken(path: Path) -> dict[str, str]:
    return {check.what: check.said for check in verify(path).of("does not hold")}


@pytest.mark.parametrize("name", ["", "result.json", "report.pdf"])
def test_an_untouched_certificate_holds(run: Path, name: str):
    found = verify(run / name)
    assert found.holds, broken(run / name)
    assert found.ids == (Result.read(run / "result.json").id,)


@pytest.mark.parametrize("name", ["channels.csv", "junit.xml", "report.html", "summary.md"])
def test_one_changed_byte_names_the_file(run: Path, name: str, tmp_path: Path):
    folder = copied(run, tmp_path / "run")
    data = bytearray((folder / name).read_bytes())
    data[len(data) // 2] ^= 1
    (folder / name).write_bytes(bytes(data))
    said = broken(folder)
    assert len(said) == 1
    assert next(iter(said)).startswith(name)


def test_a_changed_value_names_the_document(run: Path, tmp_path: Path):
    path = tmp_path / "result.json"
    text = (run / "result.json").read_text(encoding="utf-8")
    path.write_text(text.replace('"upper":272.0', '"upper":273.0'), encoding="utf-8")
    assert path.read_text(encoding="utf-8") != text
    said = broken(path)
    assert "its content was changed" in said["result.json: certificate id"]
    assert said["graded again: T1"] == "its corridor is another"


def test_a_forged_verdict_with_a_forged_id_does_not_hold(run: Path, tmp_path: Path):
    result = Result.read(run / "result.json")
    criteria = [c.model_copy(update={"value": 268.0}) if c.id == "T1" else c for c in result.criteria]
    forged = result.model_copy(update={"criteria": criteria}).with_id()
    path = tmp_path / "result.json"
    path.write_text(forged.to_json(), encoding="utf-8")
    assert set(broken(path)) == {"graded again: T1"}


def test_a_widened_corridor_with_forged_hash_and_id_does_not_hold(run: Path, tmp_path: Path):
    result = Result.read(run / "result.json")
    inputs = []
    for item in result.provenance.inputs:
        if item.role != "corridors" or item.text is None:
            inputs.append(item)
            continue
        text = item.text.replace("235 N·m", "135 N·m")
        assert text != item.text
        digest = hashlib.sha256(text.encode()).hexdigest()
        inputs.append(item.model_copy(update={"text": text, "sha256": digest}))
    provenance = result.provenance.model_copy(update={"inputs": inputs})
    path = tmp_path / "result.json"
    path.write_text(
        result.model_copy(update={"provenance": provenance}).with_id().to_json(), encoding="utf-8"
    )
    said = broken(path)
    assert said["graded again: T1"] == "its corridor is another"
    assert "windows.T1.lower is 135 N·m, shipped is 235 N·m" in said["corridors r127-pendulum"]


def test_a_definition_that_was_changed_inside_is_named(run: Path, tmp_path: Path):
    result = Result.read(run / "result.json")
    inputs = [
        item.model_copy(update={"text": f"{item.text}# changed\n"}) if item.role == "procedure" else item
        for item in result.provenance.inputs
    ]
    provenance = result.provenance.model_copy(update={"inputs": inputs})
    path = tmp_path / "result.json"
    path.write_text(
        result.model_copy(update={"provenance": provenance}).with_id().to_json(), encoding="utf-8"
    )
    assert list(broken(path)) == ["result.json: procedure procedures/pendulum.yaml"]


def rewritten(run: Path, target: Path, name: str, content: bytes | None) -> Path:
    with pikepdf.open(io.BytesIO((run / "report.pdf").read_bytes())) as document:
        if content is None:
            del document.attachments[name]
        else:
            document.attachments[name] = pikepdf.AttachedFileSpec(document, content, filename=name)
        document.save(target)
    return target


def test_one_changed_byte_in_an_attachment_names_it(run: Path, tmp_path: Path):
    with pikepdf.open(run / "report.pdf") as document:
        attached = {name: document.attachments[name].get_file().read_bytes() for name in document.attachments}
    assert {"result.json", "channels.csv", "manifest.json"} <= set(attached)
    for name, content in attached.items():
        if name in {"manifest.json", "result.json"}:
            continue
        changed = bytearray(content)
        changed[-2] ^= 1
        assert name in broken(rewritten(run, tmp_path / "changed.pdf", name, bytes(changed)))


def test_a_missing_and_an_added_attachment_are_named(run: Path, tmp_path: Path):
    said = broken(rewritten(run, tmp_path / "less.pdf", "channels.csv", None))
    assert said["channels.csv"] == "is in the manifest, but not attached"
    said = broken(rewritten(run, tmp_path / "more.pdf", "note.txt", b"trust me"))
    assert said["note.txt"] == "is attached, but not in the manifest"


def test_changed_pages_are_seen_though_the_attachments_are_whole(run: Path, tmp_path: Path):
    with pikepdf.open(run / "report.pdf") as document:
        pages = document.pages
        pages[0].contents_add(document.make_stream(b"1 g 60 660 200 60 re f"), prepend=False)
        document.save(tmp_path / "again.pdf")
    assert list(broken(tmp_path / "again.pdf")) == ["pages"]


@settings(
    max_examples=12,
    derandomize=True,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(place=st.floats(0, 0.999999), bit=st.integers(0, 7))
def test_no_flipped_bit_of_a_document_goes_unseen(run: Path, tmp_path: Path, place: float, bit: int):
    data = bytearray((run / "result.json").read_bytes())
    data[int(place * len(data))] ^= 1 << bit
    folder = tmp_path / "flipped"
    folder.mkdir(exist_ok=True)
    (folder / "result.json").write_bytes(bytes(data))
    (folder / "report.html").write_bytes((run / "report.html").read_bytes())
    try:
        assert not verify(folder).holds
    except CertkitError as error:
        assert "result.json" in str(error)  # noqa: PT017  # both outcomes are right


def test_what_is_no_certificate_is_said_so(tmp_path: Path):
    (tmp_path / "x.pdf").write_bytes(b"%PDF-1.7 no more")
    with pytest.raises(DataError, match="not a whole PDF"):
        verify(tmp_path / "x.pdf")
    with pikepdf.new() as document:
        document.add_blank_page()
        document.save(tmp_path / "y.pdf")
    with pytest.raises(DataError, match="carries no manifest"):
        verify(tmp_path / "y.pdf")
    with pytest.raises(DataError, match=r"no result\.json"):
        verify(tmp_path)
    (tmp_path / "result.json").write_text("{")
    with pytest.raises(DataError, match="damaged"):
        verify(tmp_path / "result.json")


def test_a_guard_band_certificate_is_graded_by_its_own_rule(run: Path):
    result = Result.from_json((run / "result.json").read_bytes())
    assert "guard band" in result.decision_rule
    assert verify(run / "result.json").holds


def test_every_procedure_that_is_run_here_can_be_verified(tmp_path: Path):
    for name in names("procedure"):
        result = certkit.run(name, refine=False)
        path = tmp_path / name / "result.json"
        result.write(path)
        assert verify(path).holds, (name, broken(path))
