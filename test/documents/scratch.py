# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The folder in which the commands of one document run, and its Python session."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]

# Reads blocks of code, one JSON string a line, and runs them in one namespace. Answers with one JSON line a block.
_SESSION = """
import contextlib, io, json, sys, traceback
names, answers = {"__name__": "__main__"}, sys.stdout
for line in sys.stdin:
    printed, error = io.StringIO(), ""
    with contextlib.redirect_stdout(printed):
        try:
            exec(compile(json.loads(line), "<document>", "exec"), names)
        except BaseException:
            error = traceback.format_exc()
    print(json.dumps([printed.getvalue(), error]), file=answers, flush=True)
"""


class Scratch:
    """An empty folder with the built programs in build/bin, which PATH has too, and the scripts in examples/."""

    def __init__(self, folder: pathlib.Path, programs: pathlib.Path, python: str | None) -> None:
        """`python` is an interpreter that has the package itk_sensornoise; None leaves Python blocks out."""
        self.folder = folder
        (folder / "build").mkdir()
        (folder / "build" / "bin").symlink_to(programs.resolve())
        shutil.copytree(SOURCE / "examples", folder / "examples", ignore=shutil.ignore_patterns("__pycache__"))
        self.runs = 0
        self.variables = ""
        self._python = python
        self._session: subprocess.Popen[str] | None = None
        self._environment = {
            **os.environ,
            "LC_ALL": "C.UTF-8",
            "SENSORNOISE_BUILT": "1",
            "COLUMNS": "120",
            "PATH": f"{programs.resolve()}:{os.environ['PATH']}",
            "PYTHONPATH": str(SOURCE / "test" / "documents"),
        }

    @property
    def has_python(self) -> bool:
        """Whether Python blocks are run."""
        return self._python is not None

    def has_program(self, name: str) -> bool:
        """Returns whether the build or the computer has this program."""
        return shutil.which(name, path=self._environment["PATH"]) is not None

    def write(self, name: str, text: str) -> None:
        """Writes a text file into the folder."""
        (self.folder / name).write_text(text, encoding="utf-8")

    def run(self, command: str) -> list[str]:
        """Runs a command and returns the lines of its standard output, then of its standard error."""
        if re.match(r"\w+=\S*$|\w+=\"[^\"]*\"$", command):
            self.variables += command + "\n"
            return []
        done = subprocess.run(
            ["bash", "-c", self.variables + command],
            cwd=self.folder,
            env=self._environment,
            capture_output=True,
            check=False,
        )
        self.runs += 1
        lines = (done.stdout + done.stderr).decode().splitlines()
        if done.returncode not in (0, 3):
            sys.exit(f"exit code {done.returncode} of: {command}\n" + "\n".join(lines))
        return lines

    def run_python(self, code: str) -> list[str] | None:
        """Runs a block in the session of the document and returns what it prints; None without an interpreter."""
        if self._python is None:
            return None
        if self._session is None:
            self._session = subprocess.Popen(
                [self._python, "-c", _SESSION],
                cwd=self.folder,
                env={**self._environment, "MPLBACKEND": "Agg"},
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                text=True,
            )
        assert self._session.stdin is not None and self._session.stdout is not None
        print(json.dumps(code), file=self._session.stdin, flush=True)
        printed, error = json.loads(self._session.stdout.readline() or '["", "the interpreter ended"]')
        self.runs += 1
        if error:
            sys.exit(f"{error}in the Python block\n{code}")
        return printed.splitlines()

    def close(self) -> None:
        """Ends the Python session."""
        if self._session is not None and self._session.stdin is not None:
            self._session.stdin.close()
            self._session.wait()
