"""The pipeline files that the documentation shows call commands and options that there are."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import typer
import yaml

from certkit.cli import app
from certkit.reporting.report_format import FORMATS

FOLDER = Path(__file__).parents[2] / "docs" / "how-to" / "pipelines"
FILES = sorted(FOLDER.glob("*.yml"))


def lines(part: object) -> Iterator[str]:
    """Find every shell line in a pipeline: `run: …` on GitHub, `script: […]` on GitLab."""
    if isinstance(part, dict):
        for key, value in part.items():
            if key in {"run", "script", "before_script"}:
                for text in value if isinstance(value, list) else [value]:
                    yield from str(text).splitlines()
            else:
                yield from lines(value)
    elif isinstance(part, list):
        for value in part:
            yield from lines(value)


def calls() -> Iterator[tuple[str, list[str]]]:
    for file in FILES:
        for line in lines(yaml.safe_load(file.read_text())):
            words = shlex.split(line)
            if words and words[0] == "certkit":
                yield file.name, words[1:]


CALLS = list(calls())


def test_each_pipeline_calls_certkit() -> None:
    assert {name for name, _ in CALLS} == {file.name for file in FILES}
    assert FILES


@pytest.mark.parametrize(("name", "words"), CALLS, ids=lambda v: v if isinstance(v, str) else " ".join(v))
def test_a_pipeline_calls_what_there_is(name: str, words: list[str]) -> None:
    group: Any = typer.main.get_command(app)
    command = group.commands[words[0]]
    known = {option for parameter in command.params for option in parameter.opts}
    used = [word.partition("=")[0] for word in words if word.startswith("-")]
    assert set(used) <= known, f"{name}: {words}"
    # Reading the line as the command line itself does finds missing values and stray words.
    context = command.make_context(words[0], words[1:], resilient_parsing=False)
    assert context.params
    if "formats" in context.params:
        assert set(context.params["formats"].split(",")) <= set(FORMATS)


def test_the_github_workflow_is_one() -> None:
    workflow = yaml.safe_load((FOLDER / "github.yml").read_text())
    assert True in workflow  # YAML 1.1 reads the key `on` so, and GitHub's own reader does not mind
    for job in workflow["jobs"].values():
        assert job["runs-on"]
        assert all(("run" in step) != ("uses" in step) for step in job["steps"])


def test_the_gitlab_job_keeps_its_junit_file_where_the_run_writes_it() -> None:
    pipeline = yaml.safe_load((FOLDER / "gitlab.yml").read_text())
    (job,) = pipeline.values()
    assert isinstance(job["script"], list)
    run = next(words for words in map(shlex.split, job["script"]) if words[:2] == ["certkit", "run"])
    folder = run[run.index("--out") + 1]
    assert job["artifacts"]["reports"]["junit"].startswith(f"{folder}/")
    assert "junit" in run[run.index("--format") + 1].split(",")
