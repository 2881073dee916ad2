#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Checks the signs that the tools print on a terminal: ±, e⁻ and ² in UTF-8, and ASCII letters in other character sets.

    check_terminal.py --bin build/bin

A pseudo-terminal is the standard output and the standard error of each program. Exit code 1 if a sign is wrong.
"""

import argparse
import os
import pathlib
import pty
import subprocess
import sys
import tempfile

# Each program with the signs that its output has in UTF-8, and their ASCII forms.
PRINTED = {
    "estimate-sensor-noise burst.mha --json report.json": (("±", "+-"), ("DN/e⁻", "DN/e-")),
    "export-noise-model report.json --format anscombe-transform": (("DN²", "DN^2"),),
}


def run(command: str, programs: pathlib.Path, folder: str, locale: str) -> str:
    """Runs a command whose outputs are a terminal of this locale, and returns what it shows."""
    terminal, its_end = pty.openpty()
    name, *arguments = command.split()
    environment = {**os.environ, "LC_ALL": locale}
    with subprocess.Popen(
        [programs / name, *arguments],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=its_end,
        stderr=its_end,
    ) as process:
        os.close(its_end)
        shown = b""
        try:
            while part := os.read(terminal, 65536):
                shown += part
        except OSError:  # Linux reports the end of a terminal as an error
            pass
        os.close(terminal)
    if process.returncode != 0:
        sys.exit(f"exit code {process.returncode} of: {command}\n{shown.decode(errors='replace')}")
    return shown.decode()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of the built programs")
    programs = parser.parse_args().bin.resolve()
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        run("simulate-sensor-noise --size 128x96 --frames 20 --output burst.mha", programs, folder, "C.UTF-8")
        for command, signs in PRINTED.items():
            wide, plain = (run(command, programs, folder, locale) for locale in ("C.UTF-8", "C"))
            wrong += [f"{command}: UTF-8 has no {sign}: {wide}" for sign, _ in signs if sign not in wide]
            wrong += [f"{command}: UTF-8 has {ascii_form}: {wide}" for _, ascii_form in signs if ascii_form in wide]
            wrong += [
                f"{command}: ASCII has no {ascii_form}: {plain}" for _, ascii_form in signs if ascii_form not in plain
            ]
            wrong += [] if plain.isascii() else [f"{command}: not ASCII: {plain}"]
    print("\n".join(wrong) or f"{2 * len(PRINTED)} outputs have the right signs")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
