"""What packaging says in several places is the same, and what it names exists."""

import re
import sys
import tomllib
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import pytest
import yaml

from equipoise.model.version import __version__

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))
FORMS = sorted((ROOT / ".github/ISSUE_TEMPLATE").glob("*.yml"))
NAMED_OTHERWISE = {"matplotlib": "matplotlib-base"}  # by conda-forge: without Qt
INSTRUCTIONS = {"FROM", "COPY", "RUN", "USER", "WORKDIR", "ENTRYPOINT", "CMD"}


def text(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def recipe() -> dict:
    return yaml.safe_load(text("packaging/conda/recipe.yaml"))


def steps(workflow: Path) -> list[dict]:
    jobs = yaml.safe_load(workflow.read_text(encoding="utf-8"))["jobs"]
    assert jobs
    return [step for job in jobs.values() for step in job["steps"]]


def test_the_version_is_one():
    assert PROJECT["version"] == __version__
    assert yaml.safe_load(text("CITATION.cff"))["version"] == __version__
    assert recipe()["context"]["version"] == __version__
    assert re.search(rf"^## {re.escape(__version__)} ", text("CHANGELOG.md"), re.MULTILINE)


def test_the_pythons_are_the_same_everywhere():
    minors = sorted(
        int(found.group(1))
        for line in PROJECT["classifiers"]
        if (found := re.fullmatch(r"Programming Language :: Python :: 3\.(\d+)", line))
    )
    first, last = minors[0], minors[-1]
    assert minors == list(range(first, last + 1))
    assert PROJECT["requires-python"] == f">=3.{first}"
    assert f"(3, {first}) <= sys.version_info[:2] <= (3, {last})" in text("Makefile")
    assert f"Python 3.{first} to 3.{last}" in text("Makefile")
    assert f"Python 3.{first} to 3.{last}" in text("README.md")
    tried = yaml.safe_load(text(".github/workflows/test.yml"))["jobs"]["wheel"]
    assert tried["strategy"]["matrix"]["python"] == [f"3.{first}", f"3.{last}"]


def test_conda_needs_what_pip_needs():
    wanted = {re.sub(r"(?=>=)", " ", line) for line in PROJECT["dependencies"]}
    for name, other in NAMED_OTHERWISE.items():
        wanted = {line.replace(f"{name} ", f"{other} ") for line in wanted}
    wanted.add("python " + PROJECT["requires-python"])
    assert set(recipe()["requirements"]["run"]) == wanted


def test_all_has_every_extra_but_those_that_it_leaves_out():
    extras = PROJECT["optional-dependencies"]
    (line,) = extras["all"]
    named = set(re.fullmatch(r"equipoise\[(.*)\]", line).group(1).split(","))
    assert named == set(extras) - {"all", "mavlink", "peers"}


def test_the_check_of_a_wheel_has_a_command_for_every_extra():
    spec = spec_from_file_location("check_wheel", ROOT / "packaging/check_wheel.py")
    check_wheel = sys.modules[spec.name] = module_from_spec(spec)
    spec.loader.exec_module(check_wheel)
    tried = set(check_wheel.NEEDS) | check_wheel.NOT_OF_COMMANDS
    assert tried == set(PROJECT["optional-dependencies"])


@pytest.mark.parametrize("workflow", WORKFLOWS, ids=lambda path: path.name)
def test_a_workflow_runs_what_exists(workflow):
    targets = set(re.findall(r"^([a-z]+):", text("Makefile"), re.MULTILINE))
    for step in steps(workflow):
        assert ("run" in step) != ("uses" in step)
        if "uses" in step:
            assert re.fullmatch(r"actions/[a-z-]+@v\d+", step["uses"])
        command = step.get("run", "")
        for path in re.findall(r"(?<![\w/])(?:\.ci|packaging|web|docs)/[\w./]+", command):
            assert (ROOT / path).is_file(), command
        assert set(re.findall(r"\bmake ([a-z]+)", command)) <= targets


@pytest.mark.parametrize("form", FORMS, ids=lambda path: path.name)
def test_a_form_has_questions(form):
    document = yaml.safe_load(form.read_text(encoding="utf-8"))
    assert {"name", "description", "body"} <= set(document)
    assert all(part["type"] in ("markdown", "textarea", "input") for part in document["body"])


def test_the_dockerfile_has_ten_lines_of_known_instructions():
    lines = text("Dockerfile").splitlines()
    assert len(lines) <= 10
    assert {line.split()[0] for line in lines} <= INSTRUCTIONS
    assert lines[0].startswith("FROM python:3.")


def test_the_release_workflow_publishes_what_the_release_script_makes():
    script = text("packaging/release.py")
    published = " ".join(step.get("run", "") for step in steps(WORKFLOWS[0]))
    assert WORKFLOWS[0].name == "release.yml"
    for name in ("notes.md", "SHA256SUMS"):
        assert f'"{name}"' in script
        assert f"dist/{name}" in published
