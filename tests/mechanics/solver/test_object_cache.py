"""The compiled loop is kept, and loaded without numba, and is then the same loop."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace

import numba
import numpy as np
import pytest

from certkit.definitions.loading.library import load
from certkit.mechanics import compiling
from certkit.mechanics.simulate import build
from certkit.mechanics.solver import object_cache
from certkit.mechanics.solver.kernel_arguments import KINDS, KernelArguments, block
from certkit.mechanics.solver.object_cache import Code, Entry
from certkit.mechanics.solver.time_loop import Plan, run_world
from certkit.mechanics.solver.world import World


@pytest.fixture(scope="module")
def world():
    rig = build(load("procedure", "inverse").document, load("legform", "flex-pli-gtr").document)
    return rig.assembly.finish()


@pytest.fixture(scope="module")
def code():
    return object_cache.compile_loop()


@pytest.fixture(scope="module")
def by_numba():
    return object_cache.by_numba()


@pytest.fixture
def fresh(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Path]:
    """Let this process look for the loop in an empty cache."""
    monkeypatch.setenv("CERTKIT_CACHE", str(tmp_path))
    object_cache.loop.cache_clear()
    yield tmp_path
    object_cache.loop.cache_clear()


def trajectory(world: World) -> list[np.ndarray]:
    run = run_world(world, Plan(2e-5, 0.01, 0.01), range(len(world.tables)), [0])
    return [run.readings, run.tracks, run.accelerations, run.frames, run.kinetic, run.stored, run.dissipated]


def test_the_kept_loop_gives_what_numba_gives_bit_for_bit(
    world: World, code: Code, by_numba: Entry, fresh: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(object_cache, "compile_loop", lambda: code)
    kept = trajectory(world)
    assert len(list(fresh.glob("*.o"))) == 1
    object_cache.loop.cache_clear()
    monkeypatch.setattr(object_cache, "by_llvm", lambda _: by_numba)
    for a, b in zip(kept, trajectory(world), strict=True):
        np.testing.assert_array_equal(a, b)


def test_the_loop_needs_nothing_but_llvmlite_and_the_c_library(code: Code):
    assert code is not None


@pytest.mark.usefixtures("fresh")
def test_a_process_that_finds_the_kept_loop_imports_neither_numba_nor_scipy(
    world: World, code: Code, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(object_cache, "compile_loop", lambda: code)
    trajectory(world)
    script = (
        "import sys; from certkit.mechanics.solver.object_cache import loop; "
        "import certkit.mechanics.solver.time_loop; loop(); "
        "print([name for name in ('numba', 'scipy') if name in sys.modules])"
    )
    found = subprocess.run(
        [sys.executable, "-c", script], env=dict(os.environ), capture_output=True, text=True, check=True
    )
    assert found.stdout.strip() == "[]"


@pytest.mark.parametrize(
    "damage", [lambda data: data[:-1], lambda _: b"", lambda data: data[:40] + b"x" + data[41:]]
)
def test_a_damaged_file_is_compiled_again(
    world: World, code: Code, fresh: Path, monkeypatch: pytest.MonkeyPatch, damage: Callable[[bytes], bytes]
):
    compiled = []
    monkeypatch.setattr(object_cache, "compile_loop", lambda: compiled.append(1) or code)
    trajectory(world)
    (file,) = fresh.glob("*.o")
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    object_cache.loop.cache_clear()
    trajectory(world)
    assert len(compiled) == 2
    assert file.read_bytes() == whole


def test_a_cache_that_cannot_be_written_stops_nothing(
    world: World, code: Code, fresh: Path, monkeypatch: pytest.MonkeyPatch
):
    (fresh / "file").write_text("in the way")
    monkeypatch.setenv("CERTKIT_CACHE", str(fresh / "file"))
    monkeypatch.setattr(object_cache, "compile_loop", lambda: code)
    _, tracks, *_ = trajectory(world)  # of the bodies; a law's numbers may be without end
    assert np.isfinite(tracks).all()


@pytest.mark.usefixtures("fresh")
@pytest.mark.parametrize("name", ["not the loop", None])
def test_code_that_cannot_be_loaded_is_left_to_numba(
    world: World, code: Code, by_numba: Entry, monkeypatch: pytest.MonkeyPatch, name: str | None
):
    made = code._replace(name=name) if name else None
    called = []
    monkeypatch.setattr(object_cache, "compile_loop", lambda: made)
    monkeypatch.setattr(object_cache, "by_numba", lambda: called.append(1) or by_numba)
    trajectory(world)
    assert called == [1]


def test_another_setting_of_numba_has_a_file_of_its_own(monkeypatch: pytest.MonkeyPatch):
    plain = object_cache._digest()
    monkeypatch.setenv("NUMBA_OPT", "1")
    assert object_cache._digest() != plain


def test_an_array_that_compiled_code_would_misread_is_refused():
    arrays = KernelArguments(*(np.zeros((2,) * dimensions, dtype=code) for code, dimensions in KINDS))
    assert block(arrays).shape == (len(KINDS), 4)
    with pytest.raises(TypeError, match="`mass` must be"):
        block(arrays._replace(mass=np.zeros(4)[::2]))
    with pytest.raises(TypeError, match="`layout` must be"):
        block(arrays._replace(layout=np.zeros((2, 2))))


@pytest.mark.usefixtures("fresh")
def test_without_numbas_private_names_the_public_way_is_taken_and_one_line_says_so(
    world: World,
    code: Code,
    by_numba: Entry,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
):
    another_numba = SimpleNamespace(_codegen=SimpleNamespace())
    monkeypatch.setattr(
        object_cache, "compile_loop", lambda: object_cache.object_code(another_numba, code.name)
    )
    taken = []
    monkeypatch.setattr(object_cache, "by_numba", lambda: taken.append("numba") or by_numba)
    _, tracks, *_ = trajectory(world)  # of the bodies; a law's numbers may be without end
    assert np.isfinite(tracks).all()
    assert taken == ["numba"]
    (_, said) = capsys.readouterr().err.splitlines()
    assert "every process compiles it anew" in said
    assert "_final_module" in said


def test_without_numbas_private_option_functions_are_compiled_all_the_same(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(compiling, "_without_counted_references", dict)

    def twice(x: float) -> float:
        return 2 * x

    inner = compiling.numba_compiled(twice)

    @numba.njit
    def four_times(x: float) -> float:
        return inner(x) + inner(x)

    assert four_times(1.5) == 6.0


def test_an_option_that_numba_does_not_know_is_left_out(monkeypatch: pytest.MonkeyPatch):
    real = numba.njit
    monkeypatch.setattr(
        numba, "njit", lambda **options: real(**{f"{name}_gone": options[name] for name in options})
    )
    compiling._without_counted_references.cache_clear()
    assert compiling._without_counted_references() == {}
    compiling._without_counted_references.cache_clear()
