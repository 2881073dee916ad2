# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the built programs of measure_acceptance.py, measures their processor time, and identifies them by a hash."""

import hashlib
import os
import subprocess
import tempfile
from functools import cache
from pathlib import Path
from typing import NamedTuple

HASH_DIGITS = 12  # digits of the SHA-256 of a program: two programs have the same with a probability of 2^-48


class ProgramError(RuntimeError):
    """Error for a program with an unexpected exit code."""


class Done(NamedTuple):
    """Output of a program, its exit code and its processor time, user and system together [s]."""

    output: str
    code: int
    seconds: float


def run(command, allowed=(0,)):
    """Runs a program to its end. Raises ProgramError for an exit code that is not allowed (None: all are allowed)."""
    command = list(map(str, command))
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors)
        output = process.stdout.read()
        process.stdout.close()
        # wait4() gives the processor time, which depends little on the load of the machine.
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        errors.seek(0)
        message = errors.read().decode(errors="replace").strip()
    if allowed is not None and process.returncode not in allowed:
        raise ProgramError(f"{' '.join(command)}: exit code {process.returncode}: {message}")
    return Done(output.decode(), process.returncode, usage.ru_utime + usage.ru_stime)


@cache
def hash_of(program):
    return hashlib.sha256(Path(program).read_bytes()).hexdigest()[:HASH_DIGITS]


class Programs(NamedTuple):
    """Folders of the built programs. The studies contain the estimator, so they come from its folder."""

    simulators: Path
    estimators: Path

    @property
    def simulator(self):
        return self.simulators / "simulate-sensor-noise"

    @property
    def estimator(self):
        return self.estimators / "estimate-sensor-noise"

    @property
    def studies(self):
        return self.estimators / "measure-cases"
