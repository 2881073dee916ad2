# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the command-line tools that the wheel brings: they are on the PATH, and measure what the functions measure."""

import json
import os
import shutil
import signal
import subprocess
import sysconfig

import itk
import itk_sensornoise
import pytest
from itk_sensornoise_tools import _run

NAMES = ["estimate-sensor-noise", "export-noise-model", "simulate-sensor-noise"]


def path_of(name: str) -> str:
    """Returns the path of a tool as pip installed it."""
    found = shutil.which(name, path=sysconfig.get_path("scripts"))
    assert found is not None, f"pip installed no {name}"
    return found


def run(name: str, *arguments, **options) -> subprocess.CompletedProcess:
    """Runs an installed tool to its end."""
    command = [path_of(name), *map(os.fspath, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False, **options)


@pytest.fixture(scope="module")
def stack(tmp_path_factory):
    """Returns the file of a burst that the installed tool simulated."""
    name = tmp_path_factory.mktemp("tools") / "burst.mha"
    made = run("simulate-sensor-noise", "--size", "96x64", "--frames", "30", "--seed", "4", "--output", name)
    assert made.returncode == 0, made.stderr
    return name


@pytest.mark.parametrize("name", NAMES)
def test_every_tool_has_help_and_the_version_of_the_package(name):
    shown = run(name, "--help")
    assert (shown.returncode, shown.stderr) == (0, "")
    assert f"Usage: {name} " in shown.stdout
    assert itk_sensornoise.__version__ in run(name, "--version").stdout
    assert run(name, "--no-such-option").returncode == 2


def test_tool_measures_what_the_function_measures(stack):
    shown = run("estimate-sensor-noise", stack, "--quiet", "--json", "-")
    assert shown.returncode == 0, shown.stderr
    expected = itk.estimate_sensor_noise(stack).to_dict()
    found = json.loads(shown.stdout)
    for quantity in ("gain", "offset", "read_noise"):
        assert found[quantity] == expected[quantity]


@pytest.mark.parametrize("ending", ["mha", "nrrd", "tif"])
def test_simulated_stack_is_written_in_every_format(stack, tmp_path, ending):
    name = tmp_path / f"burst.{ending}"
    made = run("simulate-sensor-noise", "--size", "96x64", "--frames", "30", "--seed", "4", "--output", name)
    assert made.returncode == 0, made.stderr
    assert itk.estimate_sensor_noise(name)["gain"] == itk.estimate_sensor_noise(stack)["gain"]


def test_report_with_maps_is_exported(stack, tmp_path):
    report, maps = tmp_path / "report.json", tmp_path / "maps"
    measured = run("estimate-sensor-noise", stack, "--quiet", "--json", report, "--maps", maps)
    assert measured.returncode == 0, measured.stderr
    assert itk.imread(os.fspath(maps / "mean.mha")).shape == (64, 96)
    shown = run("export-noise-model", "--list")
    assert shown.returncode == 0 and "dng" in shown.stdout
    exported = run("export-noise-model", report, "--format", "ndsafir")
    assert exported.returncode == 0, exported.stderr
    assert exported.stdout == itk_sensornoise.export_noise_model([json.loads(report.read_text())], "ndsafir").text


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGPIPE")
def test_closed_pipe_ends_a_tool_as_it_ends_other_programs():
    """Python ignores SIGPIPE; a program that inherited that would report an error instead."""
    reader, writer = os.pipe()
    os.close(reader)
    shown = subprocess.run(
        [path_of("export-noise-model"), "--list"], stdout=writer, stderr=subprocess.PIPE, check=False
    )
    os.close(writer)
    assert (shown.returncode, shown.stderr) == (-signal.SIGPIPE, b"")


def test_tool_that_was_not_built_is_named(capsys):
    assert _run("no-such-tool") == 69
    error = capsys.readouterr().err
    assert error.startswith("no-such-tool: ") and "built without the command-line tools" in error
