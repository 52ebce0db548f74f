"""How the code is laid out: one concept, one name, one place; nothing leads round in a circle."""

from __future__ import annotations

import ast
from collections import defaultdict
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import grimp
import pytest

PACKAGE = Path(__file__).parents[2] / "certkit"
MODULES = sorted(PACKAGE.rglob("*.py"))
MOST_LINES = 300


def test_no_two_modules_have_one_name():
    places = defaultdict(list)
    for path in MODULES:
        if path.name != "__init__.py":
            places[path.name].append(str(path.relative_to(PACKAGE)))
    assert {name: found for name, found in places.items() if len(found) > 1} == {}


def test_no_two_classes_have_one_name():
    places = defaultdict(list)
    for path in MODULES:
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.ClassDef):
                places[node.name].append(str(path.relative_to(PACKAGE)))
    assert {name: found for name, found in places.items() if len(found) > 1} == {}


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_a_module_is_short(path: Path):
    assert len(path.read_text("utf-8").splitlines()) <= MOST_LINES


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_a_module_says_what_it_is(path: Path):
    said = ast.get_docstring(ast.parse(path.read_text("utf-8")))
    assert said is not None or not path.read_text("utf-8").strip()


def test_no_imports_lead_round_in_a_circle():
    """Imports for type hints count as well: whoever reads one module of a circle has to read them all."""
    graph = grimp.build_graph("certkit", cache_dir=None)
    packages = {".".join(path.relative_to(PACKAGE.parent).parent.parts) for path in MODULES}
    imports = {
        module: {found for found in graph.find_modules_directly_imported_by(module) if found not in packages}
        for module in graph.modules
    }
    try:
        TopologicalSorter(imports).prepare()
    except CycleError as error:
        pytest.fail(f"a circle: {' <- '.join(error.args[1])}")
