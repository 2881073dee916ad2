# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the files that hosts, archives and indexes read: workflows, templates, citations, recipes."""

import json
import re
import subprocess
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).resolve().parents[2]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
YAML_FILES = [*WORKFLOWS, *sorted((ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml"))]
YAML_FILES += [ROOT / "recipe" / "recipe.yaml", ROOT / "CITATION.cff", ROOT / ".readthedocs.yaml"]

# The inputs that the reusable workflows of ITKRemoteModuleBuildTestPackageAction declare at the commit that is named:
# the end of their branch v5.4.5.
INPUTS = {
    "build-test-cxx.yml": {
        *("cmake-options", "ctest-options", "warnings-to-ignore"),
        *("itk-cmake-options", "itk-git-tag", "itk-module-deps"),
    },
    "build-test-package-python.yml": {
        *("cmake-options", "itk-wheel-tag", "itk-python-package-tag", "itk-python-package-org", "itk-module-deps"),
        *("python3-minor-versions", "manylinux-platforms", "macosx-deployment-target", "test-notebooks"),
    },
}
# The inputs of the other actions that are used here, by the action.yml of each.
STEP_INPUTS = {
    "actions/cache@v4": {"path", "key", "restore-keys"},
    "actions/checkout@v4": set(),
    "actions/deploy-pages@v4": set(),
    "actions/setup-python@v5": {"python-version"},
    "actions/upload-artifact@v4": {"name", "path"},
    "actions/upload-pages-artifact@v3": {"path"},
}
ACTION = "InsightSoftwareConsortium/ITKRemoteModuleBuildTestPackageAction"


def version_of_project() -> str:
    """Returns the version in CMakeLists.txt."""
    return re.search(r"project\(SensorNoise VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


@pytest.mark.parametrize("file", YAML_FILES, ids=lambda file: file.name)
def test_file_is_yaml_with_members(file):
    assert isinstance(yaml.safe_load(file.read_text()), dict)


@pytest.mark.parametrize("file", WORKFLOWS, ids=lambda file: file.name)
def test_workflow_says_that_it_was_not_run_and_calls_what_exists(file):
    text = file.read_text()
    assert "# Not run yet" in text
    workflow = yaml.safe_load(text)
    # YAML 1.1, which PyYAML reads, takes the key "on" for a truth value.
    assert workflow[True]["push"]["branches"] == ["main"]
    for job in workflow["jobs"].values():
        if "uses" in job:
            called = re.fullmatch(rf"{ACTION}/\.github/workflows/(.+)@[0-9a-f]{{40}}", job["uses"])[1]
            assert set(job["with"]) <= INPUTS[called]
            assert all(job["with"][name] == "v5.4.5" for name in job["with"] if name.endswith("-tag"))
            assert all(isinstance(value, str) for value in job["with"].values())
            continue
        for step in job["steps"]:
            assert ("run" in step) != ("uses" in step)
            if "uses" in step:
                assert set(step.get("with", {})) <= STEP_INPUTS[step["uses"]]
            for script in re.findall(r"bash (\S+)", step.get("run", "")):
                assert (ROOT / script).is_file()


@pytest.mark.parametrize(("argument", "code"), [("--help", 0), ("--quick", 2)])
def test_build_of_the_page_takes_no_arguments(argument, code):
    script = ROOT / "examples" / "browser" / "build.sh"
    done = subprocess.run(["bash", script, argument], capture_output=True, text=True, check=False)
    assert done.returncode == code
    assert "build.sh               no arguments" in done.stdout if code == 0 else "--quick" in done.stderr


def test_workflow_builds_by_a_preset_that_exists():
    presets = {one["name"] for one in json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]}
    named = re.findall(r"--preset (\w+)", "".join(file.read_text() for file in WORKFLOWS))
    assert named
    assert set(named) <= presets


@pytest.mark.parametrize("name", ["bug.yml", "question.yml"])
def test_issue_form_has_what_the_host_asks_for(name):
    form = yaml.safe_load((ROOT / ".github" / "ISSUE_TEMPLATE" / name).read_text())
    assert {"name", "description", "body"} <= set(form)
    fields = [part for part in form["body"] if part["type"] != "markdown"]
    assert fields
    assert all(part["type"] in ("input", "textarea") and part["attributes"]["label"] for part in fields)
    assert len({part["id"] for part in fields}) == len(fields)


def test_workflow_builds_the_modules_that_the_tests_need():
    workflow = yaml.safe_load((ROOT / ".github" / "workflows" / "build-test-package.yml").read_text())
    options = workflow["jobs"]["cxx"]["with"]["itk-cmake-options"]
    module = (ROOT / "itk-module.cmake").read_text()
    for needed in re.search(r"TEST_DEPENDS([\w\s]+?)\n  FACTORY_NAMES", module)[1].split():
        assert f"-DModule_{needed}:BOOL=ON" in options


def test_citations_have_the_version_and_the_paper():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    codemeta = json.loads((ROOT / "codemeta.json").read_text())
    recipe = yaml.safe_load((ROOT / "recipe" / "recipe.yaml").read_text())
    versions = {citation["version"], codemeta["version"], recipe["context"]["version"]}
    assert versions == {version_of_project()}
    paper = citation["references"][0]
    assert codemeta["referencePublication"]["identifier"] == f"https://doi.org/{paper['doi']}"
    assert codemeta["referencePublication"]["name"] == " ".join(paper["title"].split())
    assert codemeta["license"].endswith(f"/{citation['license']}")
