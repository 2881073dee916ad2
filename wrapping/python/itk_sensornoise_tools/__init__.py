# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The command-line tools of the wheel: programs of C++ in the folder `bin`, and one function for each of them.

The package imports neither NumPy nor ITK, so that a tool starts without delay."""

import os
import signal
import subprocess
import sys
from pathlib import Path

__all__ = ["estimate_sensor_noise", "export_noise_model", "simulate_sensor_noise"]

# The exit code of sysexits.h for a service that is not available.
_UNAVAILABLE = 69


def _run(name: str) -> int:
    """Runs a program of the folder `bin` with the arguments of this process, and returns its exit code. On systems that
    can do so, the program takes the place of this process, and nothing is returned."""
    program = Path(__file__).parent / "bin" / (f"{name}.exe" if os.name == "nt" else name)
    if not program.exists():
        print(
            f"{name}: {program} does not exist: this itk-sensornoise was built without the command-line tools. "
            "Use the functions of the package itk_sensornoise, or build the tools: documentation/reference/build.md",
            file=sys.stderr,
        )
        return _UNAVAILABLE
    arguments = [os.fspath(program), *sys.argv[1:]]
    if os.name != "nt":
        # Python ignores these signals, and a program that takes its place would go on ignoring them.
        for ignored in (signal.SIGPIPE, signal.SIGXFSZ):
            signal.signal(ignored, signal.SIG_DFL)
        os.execv(program, arguments)
    return subprocess.run(arguments, check=False).returncode


def estimate_sensor_noise() -> int:
    """Runs estimate-sensor-noise: measures the noise of a camera from files of a burst."""
    return _run("estimate-sensor-noise")


def export_noise_model() -> int:
    """Runs export-noise-model: writes a measured noise model for other programs."""
    return _run("export-noise-model")


def simulate_sensor_noise() -> int:
    """Runs simulate-sensor-noise: writes a simulated burst with known truth."""
    return _run("simulate-sensor-noise")
