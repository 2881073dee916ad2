# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The built programs that measure_acceptance.py runs, what they take, and how a result names the ones it is of."""

import hashlib
import os
import subprocess
import tempfile
from functools import cache
from pathlib import Path
from typing import NamedTuple

HASH_DIGITS = 12  # of the SHA-256 of a program: two programs of a project have the same with a chance of 2^-48


class ProgramError(RuntimeError):
    """A program ended as it should not."""


class Done(NamedTuple):
    """The output of a program, its exit code and its processor time, of user and system together [s]."""

    output: str
    code: int
    seconds: float


def run(command, allowed=(0,)):
    """Runs a program to its end. Another exit code than the allowed ones (None: all) is a ProgramError."""
    command = list(map(str, command))
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors)
        output = process.stdout.read()
        process.stdout.close()
        # Not process.wait(): processor time, unlike the clock's, hardly changes with what else the machine does.
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
    """The folders of the built programs. Studies contain the estimator: they come from its folder."""

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
