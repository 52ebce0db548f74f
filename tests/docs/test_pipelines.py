"""The pipeline files that the documentation shows call commands and options that there are."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import typer
import yaml

from certkit.cli.commands import whole_app
from certkit.reporting.report_formats import FORMATS

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


JENKINS = FOLDER / "Jenkinsfile"
FILLED = {"$CERTKIT": "certkit", "$DEFINITIONS": "definitions"}
"""What the placeholders say in the files."""


def jenkins_lines() -> Iterator[str]:
    """Find every shell line of the Jenkinsfile: between three quotes."""
    for block in re.findall(r"sh '''(.*?)'''", JENKINS.read_text("utf-8"), re.DOTALL):
        yield from (line.strip() for line in block.strip().splitlines())


def shell_lines() -> Iterator[tuple[str, str]]:
    for file in FILES:
        yield from ((file.name, line) for line in lines(yaml.safe_load(file.read_text("utf-8"))))
    yield from ((JENKINS.name, line) for line in jenkins_lines())


def calls() -> Iterator[tuple[str, list[str]]]:
    for name, line in shell_lines():
        words = [FILLED.get(word, word) for word in shlex.split(line)]
        if words and words[0] == "certkit":
            yield name, words[1:]


CALLS = list(calls())


def test_each_pipeline_calls_certkit() -> None:
    assert {name for name, _ in CALLS} == {*(file.name for file in FILES), JENKINS.name}
    assert FILES


@pytest.mark.parametrize(("name", "words"), CALLS, ids=lambda v: v if isinstance(v, str) else " ".join(v))
def test_a_pipeline_calls_what_there_is(name: str, words: list[str]) -> None:
    group: Any = typer.main.get_command(whole_app())
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
    job = pipeline["certify"]
    assert isinstance(job["script"], list)
    run = next(words for words in map(shlex.split, job["script"]) if words[:2] == ["certkit", "run"])
    folder = run[run.index("--out") + 1]
    assert job["artifacts"]["reports"]["junit"].startswith(f"{folder}/")
    assert "junit" in run[run.index("--format") + 1].split(",")


@pytest.mark.parametrize("name", sorted({name for name, _ in CALLS}))
def test_each_pipeline_installs_caches_and_keeps_and_names_its_placeholders(name: str):
    text = (FOLDER / name).read_text("utf-8")
    assert all(re.search(rf"{word}\W.*PLACEHOLDER", text) for word in ("CERTKIT", "DEFINITIONS"))
    for word in ("libpango-1.0-0", "libharfbuzz-subset0", 'pip install "$CERTKIT"', "CERTKIT_CACHE", "junit"):
        assert word in text, word
    assert re.search("artifact", text, re.IGNORECASE)


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted({name for name, _ in CALLS}))
def test_the_shell_part_of_each_pipeline_does_its_work(name: str, tmp_path: Path):
    """Its very lines, but without installing anything; PDFs are left out, which take longest."""
    own = tmp_path / "definitions" / "procedures"
    own.mkdir(parents=True)
    shutil.copy(FOLDER.parents[2] / "procedures" / "pendulum.yaml", own)
    tools = tmp_path / "tools"
    tools.mkdir()
    for tool, does in {
        "certkit": f'exec "{sys.executable}" -m certkit "$@"',
        **dict.fromkeys(("apt-get", "pip"), "exit 0"),
        "sudo": 'exec "$@"',
    }.items():
        (tools / tool).write_text(f"#!/bin/sh\n{does}\n", "utf-8")
        (tools / tool).chmod(0o755)
    said = (line for file, line in shell_lines() if file == name)
    script = "\n".join(line.replace("html,pdf,junit", "html,junit") for line in said)
    summary = tmp_path / "summary.md"
    done = subprocess.run(
        [shutil.which("sh") or "sh", "-euc", script],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        env={
            **os.environ,
            "PATH": f"{tools}{os.pathsep}{os.environ['PATH']}",
            "CERTKIT": "certkit",
            "DEFINITIONS": "definitions",
            "GITHUB_STEP_SUMMARY": str(summary),
        },
    )
    assert done.returncode == 0, done.stderr
    assert {path.parent.name for path in tmp_path.glob("runs/*/junit.xml")} == {"pendulum", "inverse"}
    assert name != "github.yml" or "pendulum" in summary.read_text("utf-8")


def test_the_projects_own_workflow_says_the_readmes_words_on_each_system():
    root = FOLDER.parents[2]
    workflow = yaml.safe_load((root / ".github" / "workflows" / "tests.yml").read_text("utf-8"))
    systems = {job["runs-on"].partition("-")[0] for job in workflow["jobs"].values()}
    assert systems == {"ubuntu", "macos", "windows"}
    said = re.findall(r"(?ms)^```sh\n(.*?)\n```$", (root / "README.md").read_text("utf-8"))
    for job in ("linux", "macos"):
        steps = [step.get("run") for step in workflow["jobs"][job]["steps"]]
        assert set(said[:2]) <= set(steps)
