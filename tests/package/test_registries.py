"""Add one, touch one: a measure, a format, a design … is one file and at most one line elsewhere."""

from __future__ import annotations

import ast
import json
import subprocess
import sys
from functools import cache
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
import pytest

import certkit.exchange.fe.readers as reader_files
import certkit.grading.measures as measure_files
import certkit.reporting
import certkit.studies.designs as design_files
from certkit.cli.commands import PANELS
from certkit.definitions.base import Section
from certkit.definitions.channel_mapping import Mapping
from certkit.definitions.extraction_case import HistoryFiles
from certkit.definitions.filters import FILTERS
from certkit.definitions.fixture_list import FIXTURES, RIG_CHANNELS
from certkit.definitions.history_formats import Format
from certkit.definitions.legform_parts import Ligament
from certkit.definitions.loading.validation import read_document
from certkit.definitions.measures import MEASURES, MeasureKind
from certkit.definitions.study import DESIGNS, Design, DesignKind
from certkit.exchange.codes import FILTER_OF_LETTER, LETTER_OF_FILTER, code_table
from certkit.exchange.fe import read_case_data
from certkit.exchange.read import read_recording
from certkit.grading.measure import NoInterval, measure
from certkit.grading.measures import method_of
from certkit.grading.trace import EvaluationWindow
from certkit.mechanics.force_laws import LAWS
from certkit.mechanics.force_laws.law import ForceLaw
from certkit.mechanics.force_laws.ligament_cable import LigamentCable
from certkit.named_class import file_name, named_class
from certkit.reporting.figure_list import FIGURES
from certkit.reporting.language_list import languages
from certkit.reporting.report_formats import FORMATS
from certkit.reporting.writing import render
from certkit.signals import Filtered
from certkit.studies.factors import Factor, Uniform
from certkit.studies.study_findings import points_of
from tests.support.sheets import bump, criterion, recording
from tests.support.synthetic_result import result

if TYPE_CHECKING:
    from types import ModuleType

PACKAGE = Path(__file__).parents[2] / "certkit"


def files(folder: str) -> set[str]:
    return {path.stem for path in (PACKAGE / folder).glob("*.py")} - {"__init__"}


@cache
def texts() -> dict[str, set[str]]:
    """Return the texts that each module holds."""
    return {
        path.relative_to(PACKAGE).as_posix(): {
            node.value
            for node in ast.walk(ast.parse(path.read_text("utf-8")))
            if isinstance(node, ast.Constant) and isinstance(node.value, str)
        }
        for path in sorted(PACKAGE.rglob("*.py"))
    }


def saying(words: set[str], besides: str) -> list[str]:
    """Return where one of these words stands as a text, besides the list."""
    return [
        f"{place}: {word}"
        for place, found in texts().items()
        if place != besides
        for word in sorted(found & words)
    ]


def with_file(monkeypatch: pytest.MonkeyPatch, package: ModuleType, tmp_path: Path, name: str, text: str):
    """Let a package find one more file, as if it lay in its folder."""
    (tmp_path / f"{name}.py").write_text(text, "utf-8")
    monkeypatch.setattr(package, "__path__", [*package.__path__, str(tmp_path)])


def test_measures_are_named_in_one_place():
    assert {file_name(word) for word in MEASURES} == files("grading/measures") - {"measure_method"}
    several_words = {word for word in MEASURES if " " in word}
    assert saying(several_words, "definitions/measures.py") == []


MADE_UP_PEAK = """
import numpy as np
from certkit.grading.measured_value import MeasuredValue
from certkit.grading.measures.measure_method import MeasureMethod

class MadeUpPeak(MeasureMethod):
    rests_on_peak = True

    def take(self, trace, criterion, filtered, window):
        count = round(0.003 / (trace.time[1] - trace.time[0])) + 1
        lowest = np.lib.stride_tricks.sliding_window_view(trace.y, count).min(axis=1)
        index = int(lowest.argmax())
        return MeasuredValue(float(lowest[index]), float(trace.time[index]), trace.y_dimension)
"""


def test_a_measure_is_one_file_and_one_line(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    with_file(monkeypatch, measure_files, tmp_path, "made_up_peak", MADE_UP_PEAK)
    monkeypatch.setattr(
        "certkit.definitions.measures.MEASURES",
        MappingProxyType({**MEASURES, "made up peak": MeasureKind()}),
    )
    asked = criterion(channel="T1").model_copy(update={"measure": "made up peak"})
    rec = recording({"T1": bump(250.0)})
    found = measure(asked, Filtered(rec), EvaluationWindow(0.0, 0.2), NoInterval())
    assert found.value == pytest.approx(250.0 * np.cos(np.pi * 0.0015 / 0.04) ** 2)
    method_of.cache_clear()


MADE_UP_FORMAT = """
FILE, SUITE_FILE, TRANSLATED, REPEATABLE = "verdict.txt", None, False, True

def write(views, *, title, paper):
    return views[0].result.verdict
"""


def test_a_report_format_is_one_file_and_one_line(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    with_file(monkeypatch, certkit.reporting, tmp_path, "made_up_format", MADE_UP_FORMAT)
    more = MappingProxyType({**FORMATS, "made up format": "certkit.reporting.made_up_format"})
    monkeypatch.setattr("certkit.reporting.report_formats.FORMATS", more)
    monkeypatch.setattr("certkit.reporting.writing.FORMATS", more)
    document = result().as_written()
    assert render(document, tmp_path / "out", ["made up format"]) == [tmp_path / "out" / "verdict.txt"]
    assert (tmp_path / "out" / "verdict.txt").read_text() == document.verdict


def test_the_commands_help_asks_which_formats_and_languages_a_result_has():
    pairs = {f"{a}, {b}" for names in (tuple(FORMATS), languages()) for a in names for b in names}
    for name in ("options.py", "report_command.py"):
        text = (PACKAGE / "cli" / name).read_text("utf-8")
        assert [pair for pair in pairs if pair in text] == []


def test_each_commands_file_is_named_once():
    assert {f"{name}_command" for name in PANELS} == {file for file in files("cli") if "_command" in file}


def test_designs_are_named_in_one_place():
    words = {word.replace(" ", "_") for word in DESIGNS}
    assert words == files("studies/designs") - {"study_design", "shares", "salib"}
    own = {f"studies/designs/{word.replace(' ', '_')}.py: {word}" for word in DESIGNS}  # in its own refusals
    assert set(saying(set(DESIGNS), "definitions/study.py")) <= own


MADE_UP_SEQUENCE = """
from certkit.studies.designs.shares import at_shares
from certkit.studies.designs.study_design import StudyDesign

class MadeUpSequence(StudyDesign):
    def points(self, design, factors, correlation):
        from scipy.stats import qmc

        return at_shares(factors, qmc.Halton(len(factors), rng=design.seed).random(design.runs))
"""


def test_a_design_is_one_file_and_one_line(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    with_file(monkeypatch, design_files, tmp_path, "made_up_sequence", MADE_UP_SEQUENCE)
    more = MappingProxyType({**DESIGNS, "made up sequence": DesignKind(by_probability=True)})
    monkeypatch.setattr("certkit.definitions.study.DESIGNS", more)
    design = Design.model_construct(kind="made up sequence", runs=9, seed=1)
    values = [float(point["a"]) for point in points_of(design, [Factor("a", "mm", Uniform(0.0, 9.0))])]
    assert len(values) == 9
    assert len({int(value) for value in values}) > 6


def test_formats_of_finite_element_histories_are_named_in_one_place():
    assert {file_name(word) for word in get_args(Format)} == files("exchange/fe/readers")
    said = saying(set(get_args(Format)), "definitions/history_formats.py")
    assert said == ["definitions/virtual_test.py: tidy csv"]  # a tidy table alone has columns


MADE_UP_SOLVER = """
import numpy as np
from certkit.exchange.fe.histories import ContactHistory, PartHistories
from certkit.exchange.fe.run_histories import RunFiles, Samples

def rows_of(path):
    rows = [line.split() for line in path.read_text().splitlines() if line.split()[:1] == ["one"]]
    time = np.array([float(row[3]) for row in rows]) * 1e-3
    force = np.array([float(row[5]) for row in rows]) * 1e3
    return rows[0][1], time, force

def read(paths, section):
    name, time, force = rows_of(paths[0])
    return PartHistories(time, {}, contacts={name: ContactHistory(0.0 * force, force)})

USUAL_FILES = ("made_up*",)

def holds(content):
    return content.lstrip().startswith(b"zero")

class MadeUpRun(RunFiles):
    def __init__(self, path):
        self.path, self.files = path, {str(path): "0" * 64}
    def history(self, asked, dimension):
        _, time, force = rows_of(self.path)
        return Samples(time, force)
    def energies(self):
        return {}

def open_run(paths, layout):
    return MadeUpRun(paths[0])
"""


MADE_UP_MAPPING = """
mapping: made_up
title: A contact that pushes
source: made up
finite elements:
  format: made-up solver
  legform model: {name: made up}
  channels: {contact force: {table: made_up, of: "1", variable: x}}
"""


def test_a_format_is_one_file_and_one_word_for_extraction_and_virtual_test(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
):
    with_file(monkeypatch, reader_files, tmp_path, "made_up_solver", MADE_UP_SOLVER)
    monkeypatch.setattr(reader_files, "Format", Literal[*get_args(Format), "made-up solver"])
    lines = [
        f" {side} 1 time {time} x {force}" for time in range(12) for side, force in (("zero", 2), ("one", -2))
    ]
    (tmp_path / "made_up").write_text("\n".join(lines))
    section = HistoryFiles.model_construct(format="made-up solver", files=["made_up"])
    contact = read_case_data(section, tmp_path).histories.contact("1")
    assert contact.force is not None
    assert list(contact.force) == [-2000.0] * 12
    (tmp_path / "mapping.yaml").write_text(MADE_UP_MAPPING.replace("  format: made-up solver\n", ""))
    mapping = read_document(tmp_path / "mapping.yaml", Mapping)
    run = read_recording(tmp_path, mapping).recording
    assert list(run["contact force"].values) == pytest.approx([-2000.0] * run.time.size)


def defined(folder: str, base: type) -> set[str]:
    """Return the files of a folder that hold a class of that base."""
    found = set()
    for name in files(folder):
        module = import_module(f"certkit.{folder.replace('/', '.')}.{name}")
        kinds = [k for k in vars(module).values() if isinstance(k, type) and k.__module__ == module.__name__]
        if any(issubclass(kind, base) and kind is not base for kind in kinds):
            found.add(name)
    return found


def test_every_force_law_is_a_file_of_its_name():
    assert {law.words().replace(" ", "_") for law in LAWS} == defined("mechanics/force_laws", ForceLaw)


def test_every_fixture_is_a_file_of_its_name():
    names = {fixture.field_name() for fixture in FIXTURES}
    assert names == defined("definitions/fixtures", Section) - {"fixture"}


MADE_UP_BEAM = """
from typing import ClassVar

from certkit.definitions.channels import FORCE, ChannelKind
from certkit.definitions.fixtures.fixture import CONTACT_FORCE, Fixture
from certkit.definitions.fixtures.rig_outlines import box, strips
from certkit.definitions.provenance import Length, Mass, Speed, Stiffness

class MadeUpBeam(Fixture):
    test_kind: ClassVar = "dynamic"
    channels: ClassVar = (
        CONTACT_FORCE,
        ChannelKind(
            "made up force", "force that is made up", FORCE, ("T0ZZZZ000000FOX0", "??ZZZZ000000FOX?")
        ),
    )
    conditions: ClassVar = ("speed",)

    beam: Mass
    sled: Mass
    crash_boxes: Stiffness
    speed: Speed
    height: Length

    def build(self, rig):
        top, height, speed = self.height / 2, float(self.height), -float(self.speed)
        x = rig.face(top, -top)
        beam = rig.add_guided_mass("beam", float(self.beam), (x, 0.0), speed=speed)
        sled = rig.add_guided_mass("sled", float(self.sled), (x + 0.3, 0.0), speed=speed)
        for z, part in strips(top, height):
            face = {"face_x": 0.0, "face_z": z, "height": part, "thickness": rig.cover}
            rig.add_force("flesh compression", carrier=beam, **face, **rig.flesh_layer())
        start, points = rig.add_curve([(0.0, 0.0), (0.1, 0.1 * self.crash_boxes)])
        behind = rig.add_force(
            "vehicle spring", first=beam, second=sled, rest=-0.3, push_start=start, push_points=points,
            pull_start=0, pull_points=0, unloading=2 * float(self.crash_boxes), residual=0.0,
            permanent_set=0.0, damping=0.0,
        )
        rig.record("made up force", behind, "force")
        rig.mark_contact("flesh compression")
        rig.longest_approach = 0.01
        rig.draw("beam", "vehicle", box(0.0, 0.1, -top, top), body=beam)

    def channel_values(self, rig, readings, bone_moment):
        return {"made up force": readings["made up force"]}
"""

WITH_ONE_LINE_MORE = """
import json, sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import certkit.definitions.fixtures

certkit.definitions.fixtures.__path__.append(sys.argv[1])
place = Path(certkit.definitions.__file__).parent / "fixture_list.py"
text = place.read_text("utf-8").replace('"free_flight",', '"free_flight", "made_up_beam",')
spec = spec_from_file_location("certkit.definitions.fixture_list", place)
listed = module_from_spec(spec)
sys.modules[spec.name] = certkit.definitions.fixture_list = listed
exec(compile(text, str(place), "exec"), vars(listed))

import certkit

sheet = Path(sys.argv[1]) / "beam.yaml"
result = certkit.run(sheet, refine=False)
data = certkit.export(result, Path(sys.argv[1]) / "beam.zip")
graded = certkit.grade(sheet, data, lenient=True)
print(json.dumps([[(c.id, c.verdict, c.value) for c in found.criteria] for found in (result, graded)]))
"""

BEAM = """
procedure: beam
title: Legform against a bumper beam
method: {document: our own, confidence: estimated}
specimen: {legform: flex-pli-gtr, part: leg, flesh: fitted}
rig:
  origin: {source: "our own, for a test", confidence: estimated}
  made up beam: {beam: 5 kg, sled: 60 kg, crash boxes: 300 N/mm, speed: 5 m/s, height: 100 mm}
run:
  until: {value: 40 ms, source: "our own, for a test", confidence: estimated}
criteria:
  - {id: MCL, title: MCL, channel: MCL elongation, filter: CFC 180, measure: max, corridor: r127-inverse/MCL}
  - {id: beam, title: Beam, channel: force that is made up, filter: CFC 180, measure: max}
"""


def test_a_fixture_is_one_file_and_one_line(tmp_path: Path):
    (tmp_path / "made_up_beam.py").write_text(MADE_UP_BEAM, "utf-8")
    (tmp_path / "beam.yaml").write_text(BEAM, "utf-8")
    done = subprocess.run(
        [sys.executable, "-c", WITH_ONE_LINE_MORE, str(tmp_path)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    simulated, graded = json.loads(done.stdout)
    assert {name: verdict for name, verdict, _ in simulated}["MCL"] in {"pass", "fail"}
    assert {name: value for name, _, value in simulated}["beam"] > 100.0
    assert [value for *_, value in graded] == pytest.approx([value for *_, value in simulated], rel=1e-4)


def test_definitions_of_fixtures_are_read_without_the_simulation():
    text = "import sys, certkit.definitions.procedure; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert not {"numpy", "numba", "pymunk", "certkit.mechanics"} & set(done.stdout.split())


def test_every_channel_that_a_fixture_declares_can_be_written_and_read():
    table = code_table()
    for kind in RIG_CHANNELS:
        assert table.channel(table.code(kind.name, "CFC 180")) == kind.name


def test_a_ligaments_numbers_are_the_cable_laws_by_their_names():
    numbers = {name for name, field in Ligament.model_fields.items() if "Number" in str(field.annotation)}
    numbers -= {"femur", "tibia"}  # its two ends
    assert numbers
    assert numbers <= set(LigamentCable.__struct_fields__)


def test_every_figure_is_drawn_by_a_function_of_a_chart_file():
    for entry in (entry for figures in FIGURES.values() for entry in figures.values()):
        for place in filter(None, (entry.draw, entry.beside)):
            module, _, function = place.partition(":")
            assert callable(getattr(import_module(f"certkit.reporting.charts.{module}"), function))


def test_filters_are_named_in_one_place():
    """Whoever takes one filter names it, as `CFC 180` for the moments that end the assessment interval."""
    said = saying(set(FILTERS) - {"CFC 180"}, "definitions/filters.py")
    assert said == ["exchange/mme_checks.py: CFC 1000"]  # what an amplifier usually has
    lettered = {words for words, kind in FILTERS.items() if kind.letter}
    assert {words for words in FILTER_OF_LETTER.values() if words} == lettered
    assert {FILTER_OF_LETTER[letter] for letter in LETTER_OF_FILTER.values()} == {"", *lettered}


def test_what_is_listed_without_its_file_is_told_by_the_file_it_needs(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
):
    with pytest.raises(
        LookupError, match=r"certkit/grading/measures/made_up_clip\.py with a class MadeUpClip"
    ):
        named_class("certkit.grading.measures", "made-up clip")
    with_file(monkeypatch, measure_files, tmp_path, "made_up_hold", "class Hold: ...\n")
    with pytest.raises(LookupError, match=r"made_up_hold\.py has no class MadeUpHold"):
        named_class("certkit.grading.measures", "made up hold")
    with_file(monkeypatch, measure_files, tmp_path, "made_up_import", "import nowhere_at_all\n")
    with pytest.raises(ModuleNotFoundError, match="nowhere_at_all"):
        named_class("certkit.grading.measures", "made up import")
