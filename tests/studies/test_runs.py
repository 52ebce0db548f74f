"""Many runs: each done once, in any number of processes, with the same numbers."""

from __future__ import annotations

import json
import math
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from support import toys

from certkit.cli.study_command import cluster_address
from certkit.errors import RunError, UsageError
from certkit.studies.execution import Execution
from certkit.studies.journal import Journal, forget
from certkit.studies.points import key_of
from certkit.studies.pools import DIED, Chunks
from certkit.studies.runs import Runs

if TYPE_CHECKING:
    from collections.abc import Callable


POINTS = [{"a": i / 7, "b": (-1.0) ** i} for i in range(100)]


def test_two_processes_give_the_bits_of_one() -> None:
    with Runs(toys.wave, Execution(processes=1)) as one, Runs(toys.wave, Execution(processes=2)) as two:
        assert one(POINTS) == two(POINTS)


def test_a_failed_run_is_a_row_with_its_error() -> None:
    with Runs(toys.fussy, Execution(processes=1)) as runs:
        good, bad = runs([{"a": 1.0}, {"a": -1.0}])
    assert good.outputs == {"root": 1.0}
    assert not good.error
    assert bad.outputs == {}
    assert "ValueError" in bad.error


def test_what_is_no_number_is_none_before_and_after_the_journal(tmp_path: Path) -> None:
    with Runs(toys.nothing, Execution(journal=tmp_path / "j", processes=1)) as runs:
        first = runs([{"a": 1.0}])
    with Runs(toys.nothing, Execution(journal=tmp_path / "j", processes=1)) as runs:
        again = runs([{"a": 1.0}])
        assert runs.done_here == 0
    assert first == again
    assert first[0].outputs == {"nan": None, "inf": None, "word": "pass"}


def test_the_same_point_is_done_once() -> None:
    with Runs(toys.wave, Execution(processes=1)) as runs:
        first, second = runs([{"a": 0.1, "b": 2.0}, {"b": 2.0, "a": 0.1}])
        assert runs.done_here == 1
    assert first == second


def test_a_run_that_kills_its_worker_costs_only_its_own_row() -> None:
    points = [{"a": float(i)} for i in range(12)]
    with Runs(toys.deadly, Execution(processes=2)) as runs:
        outcomes = runs(points)
    assert [o.error for o in outcomes] == [DIED if i == 5 else "" for i in range(12)]
    assert [o.outputs.get("twice") for o in outcomes if not o.error] == [2.0 * i for i in range(12) if i != 5]


def test_progress_tells_what_is_done_and_what_failed() -> None:
    told: list[tuple[int, int, int]] = []
    with Runs(toys.fussy, Execution(processes=1, progress=lambda *now: told.append(now))) as runs:
        runs([{"a": 1.0}, {"a": -1.0}, {"a": 1.0}])
    assert told[0] == (0, 3, 0)
    assert told[-1] == (3, 3, 1)


def test_a_torn_line_is_cut_off_and_its_run_done_again(tmp_path: Path) -> None:
    path = tmp_path / "runs.jsonl"
    with Runs(toys.wave, Execution(journal=path, processes=1)) as runs:
        whole = runs(POINTS[:3])
    text = path.read_bytes()
    path.write_bytes(text[:-20])
    with Runs(toys.wave, Execution(journal=path, processes=1)) as runs:
        assert runs(POINTS[:3]) == whole
        assert runs.done_here == 1
    assert path.read_bytes() == text


def _joined(lines: list[bytes]) -> list[bytes]:
    """Lose the end of one line and the beginning of another: what is left is valid JSON."""
    cut = b'"outputs"'
    return [lines[0][: lines[0].index(cut)] + lines[2][lines[2].index(cut) :], *lines[3:]]


@pytest.mark.parametrize(
    "damage",
    [
        _joined,
        lambda lines: [lines[0].replace(b'"z":', b'"z":1'), *lines[1:]],
        lambda lines: [lines[0].replace(b"{", b"{ ", 1), *lines[1:]],
        lambda lines: [b"\x00" * 300 + b"\n", *lines[1:]],
        lambda lines: [b"[" * 100_000 + b"\n", *lines[1:]],
    ],
    ids=["joined", "edited", "spaced", "zeros", "deep"],
)
def test_a_line_that_is_not_as_it_was_written_is_dropped_and_its_run_done_again(
    tmp_path: Path, damage: Callable[[list[bytes]], list[bytes]]
) -> None:
    path = tmp_path / "runs.jsonl"
    with Runs(toys.wave, Execution(journal=path, processes=1)) as runs:
        whole = runs(POINTS[:5])
    lines = path.read_bytes().splitlines(keepends=True)
    damaged = damage(lines)
    assert all(json.loads(line) for line in _joined(lines))
    path.write_bytes(b"".join(damaged))
    with Runs(toys.wave, Execution(journal=path, processes=1)) as runs:
        assert runs(POINTS[:5]) == whole
        assert runs.done_here == sum(line not in damaged for line in lines)
    assert sorted(path.read_bytes().splitlines(keepends=True)) == sorted(lines)


def test_a_study_that_is_begun_afresh_respects_the_one_that_is_at_work(tmp_path: Path) -> None:
    path = tmp_path / "j"
    with Runs(toys.wave, Execution(journal=path, processes=1)) as runs:
        runs(POINTS[:2])
        before = path.read_bytes()
        with pytest.raises(UsageError, match="another certkit"):
            forget(path)
        assert path.read_bytes() == before
    forget(path)
    assert path.read_bytes() == b""


def test_ctrl_c_does_not_wait_for_the_runs_that_are_at_work(tmp_path: Path) -> None:
    """The runs take an hour; the process ends, and leaves no worker behind."""
    program = tmp_path / "program.py"
    program.write_text(
        "import sys; sys.path.insert(0, sys.argv[1]); from support import toys\n"
        "from certkit.studies.execution import Execution\n"
        "from certkit.studies.runs import Runs\n"
        "if __name__ == '__main__':\n"
        "    with Runs(toys.Endless(sys.argv[2]), Execution(processes=2)) as runs:\n"
        "        runs([{'a': float(i)} for i in range(4)])\n"
    )
    command = [sys.executable, str(program), os.path.dirname(os.path.dirname(toys.__file__)), str(tmp_path)]  # noqa: PTH120  # argv
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    while len(pids := [int(file.name.partition("-")[2]) for file in tmp_path.glob("pid-*")]) < 2:
        assert process.poll() is None
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    process.wait(timeout=60)
    for pid in pids:
        with pytest.raises(ProcessLookupError):
            os.kill(pid, 0)


def test_two_processes_cannot_write_one_journal(tmp_path: Path) -> None:
    with Journal(tmp_path / "j"), pytest.raises(UsageError, match="another certkit"):
        Journal(tmp_path / "j")


def test_a_key_depends_on_every_bit_and_not_on_the_order() -> None:
    assert key_of("c", {"a": 0.1, "b": 1.0}) == key_of("c", {"b": 1.0, "a": 0.1})
    assert key_of("c", {"a": 0.1}) != key_of("c", {"a": math.nextafter(0.1, 1)})
    assert key_of("c", {"a": 0.1}) != key_of("d", {"a": 0.1})


def test_chunks_grow_for_quick_runs_and_stay_single_for_slow_ones() -> None:
    def sizes(seconds: float) -> list[int]:
        chunks = Chunks((i, {}) for i in range(400))
        seen = []
        for _ in range(8):
            size = len(next(iter(chunks)))
            chunks.learn(size, seconds * size)
            seen.append(size)
        return seen

    assert sizes(1e-5) == [1, 2, 4, 8, 16, 32, 64, 64]
    assert sizes(0.1) == [1] * 8


def test_killed_and_resumed_no_run_is_missing_and_none_is_done_twice(tmp_path: Path) -> None:
    """A parent killed with SIGKILL leaves its journal and no orphans; the next one does only the rest."""
    script = (
        "import sys; sys.path.insert(0, sys.argv[1]); from support import toys; from pathlib import Path\n"
        "from certkit.studies.execution import Execution\n"
        "from certkit.studies.runs import Runs\n"
        "def main():\n"
        "    counted, journal = toys.Counted(sys.argv[2]), Path(sys.argv[2]) / 'runs.jsonl'\n"
        "    with Runs(counted, Execution(journal=journal, processes=2)) as runs:\n"
        "        print(len(runs([{'a': float(i)} for i in range(60)])))\n"
        "if __name__ == '__main__': main()\n"
    )
    program = tmp_path / "program.py"
    program.write_text(script)
    command = [sys.executable, str(program), os.path.dirname(os.path.dirname(toys.__file__)), str(tmp_path)]  # noqa: PTH120  # argv
    journal = tmp_path / "runs.jsonl"
    first = subprocess.Popen(command)
    while not journal.exists() or journal.read_bytes().count(b"\n") < 20:
        time.sleep(0.01)
    first.send_signal(signal.SIGKILL)
    first.wait()
    recorded = journal.read_bytes().count(b"\n")
    assert 20 <= recorded < 60
    subprocess.run(command, check=True)
    keys = [json.loads(line)["key"] for line in journal.read_text().splitlines()]
    assert len(keys) == len(set(keys)) == 60
    # What was in flight when the parent died may have been begun twice, nothing else.
    begun = sum(1 for _ in tmp_path.glob("begun-*"))
    assert 60 <= begun <= 60 + 4


def test_a_script_that_workers_cannot_import_is_told_so_once(tmp_path: Path) -> None:
    program = tmp_path / "unguarded.py"
    program.write_text(
        "import sys; sys.path.insert(0, sys.argv[1]); from support import toys\n"
        "from certkit.studies.execution import Execution\n"
        "from certkit.studies.runs import Runs\n"
        "Runs(toys.wave, Execution(processes=2))([{'a': float(i), 'b': 0.0} for i in range(50)])\n"
    )
    command = [sys.executable, str(program), os.path.dirname(os.path.dirname(toys.__file__))]  # noqa: PTH120  # argv
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 1
    assert "put the call under" in done.stderr


def test_a_dask_cluster_gives_the_same_table_and_outlives_a_worker() -> None:
    distributed = pytest.importorskip("distributed")
    with Runs(toys.slow_wave, Execution(processes=1)) as here:
        expected = here(POINTS[:40])
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster:
        victim = next(iter(cluster.workers.values()))
        with Runs(toys.slow_wave, Execution(cluster=cluster.scheduler_address)) as there:
            there.progress = lambda done, *_: os.kill(victim.pid, signal.SIGKILL) if done == 10 else None
            assert there(POINTS[:40]) == expected


def test_nobody_at_the_address_is_said_so(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr("certkit.studies.dask_cluster.ANSWER_SECONDS", 0.5)
    with (
        Runs(toys.wave, Execution(cluster="tcp://127.0.0.1:9")) as runs,
        pytest.raises(UsageError, match="no Dask scheduler"),
    ):
        runs(POINTS[:2])


def test_a_cluster_that_is_lost_is_one_line() -> None:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:

        def lose(done: int, *_: int) -> None:
            if done == 5:
                cluster.close()

        with (
            Runs(toys.slow_wave, Execution(cluster=cluster.scheduler_address, progress=lose)) as runs,
            pytest.raises(RunError, match="is gone; runs that are done are kept"),
        ):
            runs(POINTS[:40])


@pytest.mark.parametrize(
    ("scheduler", "files", "said"),
    [
        ("tls://host:8786", ("a.pem", None, None), "TLS needs all three"),
        ("tcp://host:8786", ("a.pem", "b.pem", "c.pem"), "is not reached by TLS"),
        ("tls://host:8786", ("a.pem", "b.pem", "c.pem"), "a.pem: no such file"),
        (None, ("a.pem", None, None), "TLS is for a cluster"),
    ],
)
def test_tls_that_cannot_be_is_refused_before_anything_is_run(
    scheduler: str | None, files: tuple[str | None, ...], said: str
) -> None:
    with pytest.raises(UsageError, match=said):
        cluster_address(scheduler, *(Path(file) if file else None for file in files))
