"""What is imported is declared; what is heavy is capped, or an extra."""

from __future__ import annotations

import ast
import re
import sys
import tomllib
from functools import cache
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
OURS = {"certkit", "docs", "support", "tests", *(path.stem for path in (ROOT / "benchmarks").glob("*.py"))}
ELSEWHERE = {"pyisomme", "euroncap_rating_2026"}
"""Pin other versions of nearly everything, so they are no extras; see `.ci/run`."""


def imported(folder: str) -> set[str]:
    """Return the packages that a folder's files import, wherever in them, by their names in an import."""
    found = set()
    for path in (ROOT / folder).rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Import):
                found |= {alias.name for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
                found.add(node.module)
            elif isinstance(node, ast.Call):
                name = getattr(node.func, "id", getattr(node.func, "attr", ""))
                if name in {"import_module", "importorskip"} and node.args:
                    found |= {node.args[0].value} if isinstance(node.args[0], ast.Constant) else set()
    tops = {name.partition(".")[0] for name in found}
    return tops - set(sys.stdlib_module_names) - OURS - ELSEWHERE


def plain(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


@cache
def project() -> dict[str, object]:
    return tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]


def declared(*extras: str) -> dict[str, str]:
    """Return requirements by the name of their package: of certkit itself, and of some of its extras."""
    optional = project()["optional-dependencies"]
    lines = [*project()["dependencies"], *(line for extra in extras for line in optional[extra])]
    matches = [re.match(r"[A-Za-z0-9._-]+", line) for line in lines]
    return {plain(match[0]): line for match, line in zip(matches, lines, strict=True) if match}


def undeclared(folder: str, *extras: str) -> set[str]:
    there = packages_distributions()
    names = {name: {plain(each) for each in there.get(name, [name])} for name in imported(folder)}
    return {name for name, packages in names.items() if not packages & set(declared(*extras))}


def test_all_that_certkit_imports_is_declared():
    extras = [name for name in project()["optional-dependencies"] if name not in {"docs", "lint", "test"}]
    assert undeclared("certkit", *extras) == set()


@pytest.mark.parametrize("folder", ["tests", "benchmarks", "docs"])
def test_all_that_tests_and_benchmarks_import_is_declared(folder: str):
    assert undeclared(folder, *project()["optional-dependencies"]) == set()


def test_what_is_imported_without_an_extra_is_no_extra():
    optional = {plain(name) for name in declared(*project()["optional-dependencies"])} - {
        *declared(),
        "certkit",
    }
    at_the_top = set()
    for path in (ROOT / "certkit").rglob("*.py"):
        for node in ast.parse(path.read_text("utf-8")).body:
            if isinstance(node, (ast.Import, ast.ImportFrom)):
                at_the_top |= {plain(n) for n in [getattr(node, "module", None) or node.names[0].name]}
    assert not {name.partition("-")[0] for name in at_the_top} & optional


@pytest.mark.parametrize("name", ["numba", "llvmlite", "pymunk"])
def test_packages_whose_inner_parts_are_used_have_an_upper_bound(name: str):
    assert "<" in declared()[name]


def test_pandas_is_imported_by_functions_that_make_tables_only():
    for path in (ROOT / "certkit").rglob("*.py"):
        for node in ast.parse(path.read_text("utf-8")).body:
            names = [a.name for a in node.names] if isinstance(node, ast.Import) else []
            assert "pandas" not in names, path
